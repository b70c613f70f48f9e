// Jolt Physics, single precision: rigid bodies in world coordinates, joints as constraints. It reports where bodies touch, and no forces.
import {contact_of, dot, gap, minus, module_of, point_radius, rotated, scaled, serve} from "./protocol.mjs";
import {RigidBodyWorld, center_velocity, collider_turn, is_bare_point, motion_of, refuse, rigid_body_gaps} from "./rigid_bodies.mjs";

const jolt = await (await module_of("jolt-physics")).default();

const samples = "Jolt's samples and PhysicsSettings.h";
// Iterations over velocities and over positions in a step.
const iterations = {default: [10, 2], recommended: [20, 4], converged: [1000, 20]};
const hello = {
  name: "jolt", version: "1.1.0", precision: "single",
  settings: [
    {name: "default", source: samples + ": the library's own"},
    {name: "recommended", source: samples + ": more iterations where stacks and joints must be stiff; twice is ours"},
    {name: "converged", source: "ours: iterations until joints and contacts are solved to rounding"},
  ].map(setting => ({...setting, constants: {mNumVelocitySteps: iterations[setting.name][0], mNumPositionSteps: iterations[setting.name][1]}, reads: []})),
  gaps: [
    ...rigid_body_gaps,
    gap("forces of single contacts", "stated", "Jolt reports no forces: what the robot's momentum needs is shared equally among the places where it touches"),
  ],
};

/** Values that Jolt made for one expression; freed together. */
class Scratch {
  constructor() { this.made = []; }
  keep(value) { this.made.push(value); return value; }
  vec(a) { return this.keep(new jolt.Vec3(...a)); }
  place(a) { return this.keep(new jolt.RVec3(...a)); }
  quat(q) { return this.keep(new jolt.Quat(q[1], q[2], q[3], q[0])); }
  free() { for (const value of this.made) jolt.destroy(value); this.made = []; }
}
const list = v => [v.GetX(), v.GetY(), v.GetZ()];
const turn = q => [q.GetW(), q.GetX(), q.GetY(), q.GetZ()];

// Shapes meet the ground, points without a size planes that are lowered for them, and ground that is no plane.
const layers = {shapes: 0, ground: 1, points: 2, lowered: 3, uneven: 4};

function world_of(scratch) {
  const count = Object.keys(layers).length;
  const pairs = new jolt.ObjectLayerPairFilterTable(count);
  pairs.EnableCollision(layers.shapes, layers.ground);
  pairs.EnableCollision(layers.points, layers.lowered);
  pairs.EnableCollision(layers.shapes, layers.uneven);
  pairs.EnableCollision(layers.points, layers.uneven);
  const broad = new jolt.BroadPhaseLayerInterfaceTable(count, 2);
  for (const [name, layer] of Object.entries(layers))
    broad.MapObjectToBroadPhaseLayer(layer, scratch.keep(new jolt.BroadPhaseLayer(name === "shapes" || name === "points" ? 1 : 0)));
  const settings = scratch.keep(new jolt.JoltSettings());
  settings.mMaxWorkerThreads = 0;
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = broad;
  settings.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 2, pairs, count);
  return new jolt.JoltInterface(settings);
}

class World extends RigidBodyWorld {
  constructor(experiment) {
    super(experiment);
    const scratch = new Scratch();
    this.jolt = world_of(scratch);
    this.system = this.jolt.GetPhysicsSystem();
    this.interface = this.system.GetBodyInterface();
    const settings = this.system.GetPhysicsSettings();
    [settings.mNumVelocitySteps, settings.mNumPositionSteps] = iterations[experiment.settings];
    settings.mAllowSleeping = false;
    settings.mDeterministicSimulation = true;
    this.system.SetPhysicsSettings(settings);
    this.system.SetGravity(scratch.vec(experiment.gravity));
    this.touches = [];
    this.listen();
    this.add_ground(
      (half, position, turned, is_lowered) =>
        this.add_piece(scratch, new jolt.BoxShapeSettings(scratch.vec(half), 0), position, turned, is_lowered ? layers.lowered : layers.ground),
      (piece, position, turned) => this.add_piece(scratch, this.shape(scratch, piece), position, turned, layers.uneven));
    this.numbers = new Map();  // of bodies, by Jolt's own
    this.bodies = experiment.bodies.map((body, i) => this.add_body(scratch, body, i));
    this.joints = experiment.joints.map(joint => this.add_joint(scratch, joint));
    scratch.free();
    this.scratch = new Scratch();  // of a step
  }

  listen() {
    const listener = new jolt.ContactListenerJS();
    const note = (first, second, manifold) => {
      const [one, two] = [first, second].map(body => jolt.wrapPointer(body, jolt.Body).GetID().GetIndexAndSequenceNumber());
      const at = jolt.wrapPointer(manifold, jolt.ContactManifold), count = at.get_mRelativeContactPointsOn1().size();
      const body = this.numbers.get(two) ?? this.numbers.get(one);
      // Out of the ground: Jolt's normal moves the second body out of the first.
      const normal = scaled(this.numbers.has(two) ? 1 : -1, list(at.get_mWorldSpaceNormal()));
      for (let k = 0; k < count; ++k) this.touches.push({body, place: list(at.GetWorldSpaceContactPointOn1(k)), normal, depth: at.get_mPenetrationDepth()});
    };
    listener.OnContactValidate = () => jolt.ValidateResult_AcceptAllContactsForThisBodyPair;
    listener.OnContactAdded = note;
    listener.OnContactPersisted = note;
    listener.OnContactRemoved = () => {};
    this.listener = listener;
    this.system.SetContactListener(listener);
  }

  shape(scratch, shape) {
    // A convex radius would round edges.
    const sharp = 0;
    switch (shape.type) {
      case "sphere": return new jolt.SphereShapeSettings(shape.radius);
      case "point": return new jolt.SphereShapeSettings(shape.radius || point_radius);
      case "box": return new jolt.BoxShapeSettings(scratch.vec(scaled(0.5, shape.dimensions)), sharp);
      case "cylinder": return new jolt.CylinderShapeSettings(0.5 * shape.length, shape.radius, sharp);
      case "capsule": return new jolt.CapsuleShapeSettings(0.5 * shape.length, shape.radius);
      case "hull": {
        const hull = new jolt.ConvexHullShapeSettings();
        hull.mMaxConvexRadius = sharp;
        for (let k = 0; k < shape.vertices.length; k += 3) hull.mPoints.push_back(scratch.vec(shape.vertices.slice(k, k + 3)));
        return hull;
      }
      case "triangles": {
        const triangles = new jolt.TriangleList(), corner = k => {
          const [x, y, z] = shape.vertices.slice(3 * k, 3 * k + 3);
          return scratch.keep(new jolt.Float3(x, y, z));
        };
        triangles.resize(shape.triangles.length / 3);
        for (let k = 0; k < shape.triangles.length / 3; ++k)
          [0, 1, 2].forEach(c => triangles.at(k).set_mV(c, corner(shape.triangles[3 * k + c])));
        return new jolt.MeshShapeSettings(triangles);
      }
      default: return refuse(`Jolt has no shape ${shape.type} here`);
    }
  }

  add_piece(scratch, settings, position, turned, layer) {
    const made = settings.Create();
    if (made.HasError()) refuse(`Jolt does not make a piece of ground: ${made.GetError().c_str()}`);
    const of = scratch.keep(new jolt.BodyCreationSettings(made.Get(), scratch.place(position), scratch.quat(turned), jolt.EMotionType_Static, layer));
    // Of a contact Jolt takes the root of the product of both frictions, and the greater restitution: the body decides.
    of.mFriction = 1;
    of.mRestitution = 0;
    this.interface.CreateAndAddBody(of, jolt.EActivation_DontActivate);
  }

  add_body(scratch, body, number) {
    const compound = new jolt.StaticCompoundShapeSettings();
    for (const collider of body.colliders)
      compound.AddShape(scratch.vec(collider.position), scratch.quat(collider_turn(collider)), this.shape(scratch, collider), 0);
    const bare = new Set(body.colliders.map(is_bare_point));
    if (bare.size > 1) refuse("in Jolt a body touches by shapes, or by points of radius 0");
    const settings = body.colliders.length > 0 ? compound : new jolt.EmptyShapeSettings();
    const made = settings.Create();
    if (made.HasError()) refuse(`Jolt does not make the shapes of ${body.name}: ${made.GetError().c_str()}`);
    // The place where Jolt has the centre of mass is ours, not the shapes'.
    const center = made.Get().GetCenterOfMass();
    const moved = new jolt.OffsetCenterOfMassShapeSettings(scratch.vec(minus(body.center_of_mass, list(center))), settings).Create();
    const kind = body.mobile ? jolt.EMotionType_Dynamic : jolt.EMotionType_Static;
    const of = scratch.keep(new jolt.BodyCreationSettings(moved.Get(), scratch.place(body.position), scratch.quat(body.orientation), kind, bare.has(true) ? layers.points : layers.shapes));
    const contact = body.colliders.length > 0 ? contact_of(this.experiment, body.colliders[0].material, this.ground) : null;
    if (new Set(body.colliders.map(collider => collider.material)).size > 1) refuse("in Jolt a body has one material");
    of.mFriction = (contact?.kinetic_friction ?? 0) ** 2;
    of.mRestitution = contact?.restitution ?? 0;
    of.mLinearDamping = of.mAngularDamping = 0;
    of.mApplyGyroscopicForce = true;
    of.mAllowSleeping = false;
    of.mMaxLinearVelocity = of.mMaxAngularVelocity = 1e4;
    if (body.mobile) {
      const [xx, yy, zz, xy, xz, yz] = body.inertia, inertia = of.mMassPropertiesOverride;
      inertia.mMass = body.mass;
      const matrix = scratch.keep(new jolt.Mat44());
      [[xx, xy, xz, 0], [xy, yy, yz, 0], [xz, yz, zz, 0], [0, 0, 0, 1]].forEach((column, k) => matrix.SetColumn4(k, scratch.keep(new jolt.Vec4(...column))));
      inertia.mInertia = matrix;
      of.mOverrideMassProperties = jolt.EOverrideMassProperties_MassAndInertiaProvided;
    }
    const own = this.interface.CreateBody(of);
    this.numbers.set(own.GetID().GetIndexAndSequenceNumber(), number);
    this.interface.AddBody(own.GetID(), jolt.EActivation_Activate);
    if (body.mobile) {
      own.SetLinearVelocity(scratch.vec(center_velocity(body)));
      own.SetAngularVelocity(scratch.vec(body.angular_velocity));
    }
    return {own, mass: body.mass, center: body.center_of_mass, mobile: body.mobile, colliders: body.colliders.length};
  }

  add_joint(scratch, joint) {
    const turns = joint.type !== "prismatic";
    const settings = scratch.keep(turns ? new jolt.HingeConstraintSettings() : new jolt.SliderConstraintSettings());
    settings.mSpace = jolt.EConstraintSpace_LocalToBodyCOM;
    const axis = [0, 0, 1], normal = [1, 0, 0];
    settings.mPoint1 = scratch.place(minus(joint.position, this.bodies[joint.parent].center));
    settings.mPoint2 = scratch.place(scaled(-1, this.bodies[joint.body].center));
    const name = turns ? "mHingeAxis" : "mSliderAxis";
    settings[name + 1] = scratch.vec(rotated(joint.orientation, axis));
    settings.mNormalAxis1 = scratch.vec(rotated(joint.orientation, normal));
    settings[name + 2] = scratch.vec(axis);
    settings.mNormalAxis2 = scratch.vec(normal);
    this.system.AddConstraint(settings.Create(this.bodies[joint.parent].own, this.bodies[joint.body].own));
    return {...joint};
  }

  motion({own, center}) {
    return motion_of(list(own.GetPosition()), turn(own.GetRotation()), list(own.GetLinearVelocity()), list(own.GetAngularVelocity()), center);
  }
  push({own}, force, place) { own.AddForce(this.scratch.vec(force), this.scratch.place(place)); }
  twist({own}, torque) { own.AddTorque(this.scratch.vec(torque)); }

  advance() {
    this.touches = [];
    this.jolt.Step(this.experiment.deltat, 1);
    this.scratch.free();
  }

  /** Equal parts of what the momentum needs, where that presses. */
  contacts(robot, needed) {
    const own = this.touches.filter(touch => robot.includes(touch.body)), force = scaled(1 / own.length, needed);
    return own.filter(({normal}) => dot(force, normal) > 0)
      .map(({body, place, depth}) => ({body, collider: this.bodies[body].colliders === 1 ? 0 : -1, place, force, depth}));
  }

  close() {
    jolt.destroy(this.jolt);
    jolt.destroy(this.listener);
  }
}

serve(hello, experiment => new World(experiment));
