// Rapier 3D, single precision, deterministic build: rigid bodies in world coordinates, joints as constraints.
import {contact_of, gap, minus, module_of, plus, point_radius, principal, rotated, scaled, serve} from "./protocol.mjs";
import {RigidBodyWorld, axis_turn, center_velocity, collider_turn, is_bare_point, motion_of, refuse, rigid_body_gaps} from "./rigid_bodies.mjs";

const rapier = await module_of("@dimforge/rapier3d-deterministic-compat");
await rapier.init();

const guide = "user guide, Integration parameters";
// Substeps, and sweeps over the constraints in each.
const iterations = {default: [4, 1], recommended: [20, 1], converged: [1, 1000]};
const constants = name => ({numSolverIterations: iterations[name][0], numInternalPgsIterations: iterations[name][1], "contact natural frequency [Hz]": 30});
const hello = {
  name: "rapier", version: rapier.version(), precision: "single",
  settings: [
    {name: "default", source: guide + ": the library's own"},
    {name: "recommended", source: guide + ": more solver iterations where accuracy counts; 20 is ours"},
    {name: "converged", source: "ours: one substep, and sweeps until joints and contacts are solved to rounding"},
  ].map(setting => ({...setting, constants: constants(setting.name), reads: []})),
  gaps: [
    ...rigid_body_gaps,
    gap("prismatic joints", "refused", "choose engine mujoco_3_14"),
    gap("friction of single contacts", "stated", "Rapier reports normal forces alone: what the robot's momentum needs beside them is shared among its contacts by load"),
  ],
};

const vector = a => ({x: a[0], y: a[1], z: a[2]});
const rotation = q => ({w: q[0], x: q[1], y: q[2], z: q[3]});
const list = v => [v.x, v.y, v.z];
const turn = q => [q.w, q.x, q.y, q.z];

// Who meets whom: shapes the ground, points without a size planes that are lowered for them, and ground that is no plane.
const shapes = 1, ground = 2, points = 4, lowered = 8, uneven = 16;
const groups = (own, others) => own << 16 | others;

function shape_of(shape) {
  const {ColliderDesc} = rapier;
  switch (shape.type) {
    case "sphere": return ColliderDesc.ball(shape.radius);
    case "point": return ColliderDesc.ball(shape.radius || point_radius);
    case "box": return ColliderDesc.cuboid(...scaled(0.5, shape.dimensions));
    case "cylinder": return ColliderDesc.cylinder(0.5 * shape.length, shape.radius);
    case "capsule": return ColliderDesc.capsule(0.5 * shape.length, shape.radius);
    case "hull": return ColliderDesc.convexHull(new Float32Array(shape.vertices)) ?? refuse("Rapier makes no hull of these vertices");
    case "triangles": return ColliderDesc.trimesh(new Float32Array(shape.vertices), new Uint32Array(shape.triangles));
    default: return refuse(`Rapier has no shape ${shape.type} here`);
  }
}

class World extends RigidBodyWorld {
  constructor(experiment) {
    super(experiment);
    this.world = new rapier.World(vector(experiment.gravity));
    this.world.integrationParameters.dt = experiment.deltat;
    [this.world.integrationParameters.numSolverIterations, this.world.integrationParameters.numInternalPgsIterations] = iterations[experiment.settings];
    const fixed = this.world.createRigidBody(rapier.RigidBodyDesc.fixed());
    const add = (shape, position, turned, own, others) =>
      this.world.createCollider(this.surface(shape, 1, 1).setTranslation(...position).setRotation(rotation(turned)).setCollisionGroups(groups(own, others)), fixed);
    this.add_ground(
      (half, position, turned, is_lowered) => add(rapier.ColliderDesc.cuboid(...half), position, turned, is_lowered ? lowered : ground, is_lowered ? points : shapes),
      (piece, position, turned) => add(shape_of(piece), position, turned, uneven, shapes | points));
    this.bodies = experiment.bodies.map(body => this.add_body(body));
    this.joints = experiment.joints.map(joint => this.add_joint(joint));
  }

  /** Both coefficients of a contact are multiplied: the ground's are 1. */
  surface(shape, friction, restitution) {
    const product = rapier.CoefficientCombineRule.Multiply;
    return shape.setDensity(0).setFriction(friction).setFrictionCombineRule(product).setRestitution(restitution).setRestitutionCombineRule(product);
  }

  add_body(body) {
    const of = body.mobile ? rapier.RigidBodyDesc.dynamic() : rapier.RigidBodyDesc.fixed();
    of.setTranslation(...body.position).setRotation(rotation(body.orientation));
    if (body.mobile) {
      const {values, turn} = principal(body.inertia);
      of.setCanSleep(false).setAdditionalMassProperties(body.mass, vector(body.center_of_mass), vector(values), rotation(turn));
      of.setLinvel(...center_velocity(body)).setAngvel(vector(body.angular_velocity));
    }
    const made = this.world.createRigidBody(of);
    const colliders = body.colliders.map(collider => {
      const contact = contact_of(this.experiment, collider.material, this.ground);
      const shape = this.surface(shape_of(collider), contact?.kinetic_friction ?? 0, contact?.restitution ?? 0);
      shape.setTranslation(...collider.position).setRotation(rotation(collider_turn(collider)));
      shape.setCollisionGroups(is_bare_point(collider) ? groups(points, lowered | uneven) : groups(shapes, ground | uneven));
      return this.world.createCollider(shape, made);
    });
    return {made, colliders, mass: body.mass, center: body.center_of_mass, mobile: body.mobile};
  }

  add_joint(joint) {
    const z = [0, 0, 1], axis = rotated(joint.orientation, z);
    const data = rapier.JointData.revoluteWithAxes(vector(joint.position), vector([0, 0, 0]), vector(axis), vector(z));
    this.world.createImpulseJoint(data, this.bodies[joint.parent].made, this.bodies[joint.body].made, true);
    return {...joint};
  }

  motion({made, center}) {
    return motion_of(list(made.translation()), turn(made.rotation()), list(made.linvel()), list(made.angvel()), center);
  }
  push({made}, force, place) { made.addForceAtPoint(vector(force), vector(place), true); }
  twist({made}, torque) { made.addTorque(vector(torque), true); }

  advance() {
    this.world.step();
    for (const {made} of this.bodies) {  // else they stay
      made.resetForces(false);
      made.resetTorques(false);
    }
  }

  /** Normal forces are Rapier's; what the momentum needs beside them is shared by load. */
  contacts(robot, needed) {
    const found = [];
    for (const i of robot)
      this.bodies[i].colliders.forEach((collider, k) => {
        this.world.contactPairsWith(collider, other => this.world.contactPair(collider, other, (manifold, flipped) => {
          // The manifold's normal is out of its first collider.
          const normal = scaled(flipped ? 1 : -1, list(manifold.normal()));
          for (let c = 0; c < manifold.numContacts(); ++c) {
            const load = manifold.contactImpulse(c) / this.experiment.deltat;
            const place = manifold.solverContactPoint(Math.min(c, manifold.numSolverContacts() - 1));
            if (load > 0 && place) found.push({body: i, collider: k, place: list(place), load, force: scaled(load, normal), depth: -manifold.contactDist(c)});
          }
        }));
      });
    const load = found.reduce((sum, contact) => sum + contact.load, 0);
    const rest = found.reduce((left, contact) => minus(left, contact.force), needed);
    return found.map(contact => ({...contact, force: plus(contact.force, scaled(contact.load / load, rest))}));
  }

  close() { this.world.free(); }
}

serve(hello, experiment => new World(experiment));
