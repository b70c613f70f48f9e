# When a hook survives a stance, foretold from what configs/scenes/walking_stiffness.hook and configs/robots/leg.hook state, and from nothing
# measured: the hexapod as one rigid body that heaves, pitches and rolls on six massless feet over level ground (docs/studies/low_stiffness.md).
#   awk -v cruse=0 -v stiffness=3000 [-v pconstant=60] [-v damping_ratio=0.1] -f scripts/heave_model.awk
# prints gait, stiffness [N/m], contacts lost per stance, mean depth of a standing foot that touches [m], heave from top to bottom [m].

# Height of a swinging foot and its rate, s from 0 to 1 (docs/gaits.md).
function height(s) { return 64 * step_height * (s * (1 - s)) ^ 3 }
function climb(s) { return 192 * step_height * (s * (1 - s)) ^ 2 * (1 - 2 * s) / swing }

BEGIN {
  gravity = 9.81
  if (pconstant == 0) pconstant = 60
  if (damping_ratio == 0) damping_ratio = 0.1
  dconstant = 0.3
  deg = atan2(0, -1) / 180
  femur = 0.1; coxa = 0.05; lift = 30 * deg; spread = 30 * deg
  lever = femur * cos(lift)  # of a foot's load about the femur's axis; about the knee, over an upright tibia, none
  leg_stiffness = pconstant / lever ^ 2
  leg_damping = dconstant / lever ^ 2
  load = 13.8
  ground_damping = 2 * damping_ratio * sqrt(stiffness * load / gravity)

  # 2 kg of base, 0.3 x 0.2 x 0.06 m, and six legs of 0.37 kg whose middle is `out` from the hip.
  mass = 2 + 6 * 0.37
  out = (0.1 * coxa / 2 + 0.15 * (coxa + lever / 2) + 0.12 * (coxa + lever)) / 0.37
  pitch_inertia = 2 / 12 * (0.3 ^ 2 + 0.06 ^ 2) + 4 * 0.37 * (0.12 + out * sin(spread)) ^ 2
  roll_inertia = 2 / 12 * (0.2 ^ 2 + 0.06 ^ 2) + 0.37 * (4 * (0.1 + out * cos(spread)) ^ 2 + 2 * (0.1 + out) ^ 2)

  forward = 0.1; step_height = 0.05
  # Cruse's rules settle at this speed with swings that follow each other along a side, the sides half a cycle apart.
  swing = cruse ? 0.25 : 0.27
  period = cruse ? 0.75 : 0.6
  duty = 1 - swing / period
  reach = coxa + lever
  for (i = 0; i < 6; ++i) {
    row = i % 3 - 1; side = i < 3 ? -1 : 1
    foot_x[i] = row * (0.12 + reach * (row ? sin(spread) : 0))
    foot_y[i] = side * (0.1 + reach * (row ? cos(spread) : 1))
    touch_down[i] = cruse ? (i % 3) / 3 + (i < 3 ? 0 : 0.5) : (i % 2) / 2
    foot_z[i] = 0
  }

  dt = 2e-4
  last = 10 * period / dt; first = 5 * period / dt
  for (n = 0; n < last; ++n) {
    up = -mass * gravity; nose = 0; lean = 0
    for (i = 0; i < 6; ++i) {
      clock = n * dt / period - touch_down[i] + 2
      clock -= int(clock)
      stands = clock < duty
      s = (clock - duty) / (1 - duty)
      x = foot_x[i] + forward * period * (stands ? duty / 2 - clock : duty * (s - 0.5))
      # Where the foot were without load, and how fast; then the foot between the leg's spring and the ground's.
      free = z - pitch * x + roll * foot_y[i] + (stands ? 0 : height(s))
      rate = dz - dpitch * x + droll * foot_y[i] + (stands ? 0 : climb(s))
      dfoot = (-stiffness * foot_z[i] - leg_stiffness * (foot_z[i] - free) + leg_damping * rate) / (ground_damping + leg_damping)
      carried = foot_z[i] < 0 ? -stiffness * foot_z[i] - ground_damping * dfoot : 0
      if (!(carried > 0)) {
        carried = 0
        dfoot = rate - leg_stiffness / leg_damping * (foot_z[i] - free)
      }
      inside = foot_z[i] < 0
      if (stands && !stood[i]) { touched[i] = 0; whole[i] = n > first }
      if (stands && inside) touched[i] = 1
      if (stands && stood[i] && whole[i] && was_inside[i] && !inside) ++losses
      if (!stands && stood[i] && whole[i] && touched[i]) ++stances
      if (stands && whole[i] && inside) { depth -= foot_z[i]; ++deep }
      stood[i] = stands; was_inside[i] = inside
      foot_z[i] += dt * dfoot
      up += carried; nose -= carried * x; lean += carried * foot_y[i]
    }
    dz += dt * up / mass; z += dt * dz
    dpitch += dt * nose / pitch_inertia; pitch += dt * dpitch
    droll += dt * lean / roll_inertia; roll += dt * droll
    if (n < first) continue
    if (!seen || z > top) top = z
    if (!seen || z < bottom) bottom = z
    seen = 1
  }
  printf "%d,%g,%.3g,%.4g,%.4g\n", cruse, stiffness, stances ? losses / stances : 0, deep ? depth / deep : 0, top - bottom
}
