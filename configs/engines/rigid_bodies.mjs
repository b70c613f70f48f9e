// What engines share that know rigid bodies in world coordinates, held together by joints that are constraints, and report no whole
// contact forces.
import {Refusal, conjugate, cross, dot, gap, minus, one_ground, plus, point_radius, rotated, scaled, times, turn_to} from "./protocol.mjs";

export const rigid_body_gaps = [
  gap("static friction that differs from kinetic", "noticed", "this engine has one coefficient of friction, and it is the kinetic one"),
  gap("rotor inertias", "refused", "choose engine mujoco_3_14"),
  gap("links without mass", "refused", "give every link a mass"),
  gap("bases that are kept in a plane", "refused", "choose engine mujoco_3_14"),
];

export function refuse(reason) { throw new Refusal(reason); }

const none = [1, 0, 0, 0], from_y_to_z = [Math.SQRT1_2, Math.SQRT1_2, 0, 0];
/** The turn of a shape's frame to ours: these engines' cylinders and capsules stand along y. */
export const axis_turn = shape => shape.type === "cylinder" || shape.type === "capsule" ? from_y_to_z : none;
/** Where a collider stands in its body. */
export const collider_turn = collider => times(collider.orientation ?? none, axis_turn(collider));
/** Whether it is a point without a size: a ball of point_radius, for which the ground is lowered. */
export const is_bare_point = collider => collider.type === "point" && !collider.radius;

/** Velocity of a body's centre of mass at the start. */
export const center_velocity = body =>
  plus(body.velocity, cross(body.angular_velocity, rotated(body.orientation, body.center_of_mass)));

/**
 * A world that steps. An engine's own class has `bodies`, each {mobile, mass, center, ...}, and `joints`, the experiment's, and says
 *   motion(body): {position, orientation, velocity, spin, center_velocity}, of the body's frame but the last;
 *   push(body, force, place), twist(body, torque): over the next step, in world axes;
 *   advance(): the step;
 *   contacts(robot, needed): of the bodies `robot`, [{body, collider, place, force, depth}], where `needed` is the force of the
 *     ground on all of them by their momentum over the step.
 */
export class RigidBodyWorld {
  constructor(experiment) {
    this.experiment = experiment;
    this.ground = one_ground(experiment);
    this.robots = [...new Set(experiment.bodies.map(body => body.robot))]
      .map(name => experiment.bodies.map((body, i) => body.robot === name && body.mobile ? i : -1).filter(i => i >= 0));
  }

  /** Pieces of the ground: add_box(half_sizes, position, turn, is_lowered) for planes, of which there are none here, add(shape, position, turn) for others. */
  add_ground(add_box, add) {
    const wide = 100, deep = 5;
    // Triangles have no inside: a ball whose centre is on them falls through.
    if (this.experiment.ground.some(piece => piece.type === "triangles") && this.experiment.bodies.some(body => body.colliders.some(is_bare_point)))
      refuse("points without a size fall through ground that is no plane in this engine: give the ContactPoints a radius, or write touch = shapes");
    for (const piece of this.experiment.ground)
      if (piece.type === "plane") {
        for (const down of [0, point_radius])
          add_box([wide, wide, deep], scaled(piece.offset - down - deep, piece.normal), turn_to(piece.normal), down > 0);
      } else {
        const place = piece.type === "triangles" ? {position: [0, 0, 0], orientation: none} : piece;
        add(piece, place.position, times(place.orientation, axis_turn(piece)));
      }
  }

  step(torques, loads, states) {
    const before = this.bodies.map(body => this.motion(body)), outside = this.bodies.map(() => [0, 0, 0]);
    for (const load of loads) {
      const {position, orientation} = before[load.body];
      this.push(this.bodies[load.body], load.force, plus(position, rotated(orientation, load.point)));
      this.twist(this.bodies[load.body], load.torque);
      outside[load.body] = plus(outside[load.body], load.force);
    }
    this.joints.forEach((joint, k) => this.drive(joint, torques[k], before));
    this.advance();
    const after = this.bodies.map(body => this.motion(body));
    for (const {position, orientation, velocity, spin} of after) states.push(...position, ...orientation, ...velocity, ...spin);
    for (const joint of this.joints) states.push(...this.coordinate(joint, after));
    const contacts = this.robots.flatMap(robot => this.contacts(robot, this.needed_force(robot, before, after, outside)));
    states.push(contacts.length);
    for (const {body, collider, place, force, depth} of contacts) states.push(body, collider, ...place, ...force, depth);
  }

  /** A joint's torque or force, on its body and against its parent. */
  drive(joint, torque, motions) {
    const {position, orientation} = motions[joint.body];
    for (const [number, sign] of [[joint.body, 1], [joint.parent, -1]]) {
      const along = scaled(sign * torque, rotated(orientation, [0, 0, 1]));
      if (!this.bodies[number].mobile) continue;
      if (joint.type === "prismatic")
        this.push(this.bodies[number], along, position);
      else
        this.twist(this.bodies[number], along);
    }
  }

  /** Position and rate of a joint, from its two bodies; an angle keeps count of whole turns. */
  coordinate(joint, motions) {
    const parent = motions[joint.parent], child = motions[joint.body], axis = rotated(child.orientation, [0, 0, 1]);
    if (joint.type === "prismatic") {
      const from = plus(parent.position, rotated(parent.orientation, joint.position)), arm = minus(child.position, parent.position);
      return [dot(minus(child.position, from), axis), dot(minus(child.velocity, plus(parent.velocity, cross(parent.spin, arm))), axis)];
    }
    const relative = times(conjugate(times(parent.orientation, joint.orientation)), child.orientation);
    const angle = 2 * Math.atan2(relative[3], relative[0]);
    joint.angle = angle + 2 * Math.PI * Math.round((joint.angle - angle) / (2 * Math.PI));
    return [joint.angle, dot(minus(child.spin, parent.spin), axis)];
  }

  /** m dv/dt less weight and loads, summed over the bodies of a robot. */
  needed_force(robot, before, after, outside) {
    const {deltat, gravity} = this.experiment;
    return robot.reduce((sum, i) => {
      const {mass} = this.bodies[i];
      const gained = scaled(mass / deltat, minus(after[i].center_velocity, before[i].center_velocity));
      return plus(sum, minus(minus(gained, scaled(mass, gravity)), outside[i]));
    }, [0, 0, 0]);
  }
}

/** What `motion` gives, from the numbers that such an engine has. */
export function motion_of(position, orientation, center_velocity, spin, center) {
  return {position, orientation, spin, center_velocity, velocity: minus(center_velocity, cross(spin, rotated(orientation, center)))};
}
