// Prints the scene of an MCAP file, its schemas and messages checked against those that Foxglove publishes (@foxglove/schemas):
//   topic NAME SCHEMA MESSAGES   transform LOG_TIME SEC NSEC PARENT CHILD x y z qw qx qy qz
//   entity LOG_TIME SEC NSEC ID FRAME LOCKED LIFETIME   material ID NAME
//   cube ID x y z qw qx qy qz sx sy sz   sphere (the same)   cylinder (the same) BOTTOM_SCALE TOP_SCALE
//   triangle ID ax ay az bx by bz cx cy cz
// Fields are separated by tabs. usage: node read_scene.mjs indexed|stream FILE
import published from "@foxglove/schemas/jsonschema.js";
import { contents, json } from "./open.mjs";

function fail(place, what) {
  throw new Error(`${place}: ${what}`);
}

/// What `ours` says must be in the published schema with the same type and name, and all that this requires must be in ours. A
/// list of which ours says nothing about its items may hold none.
function compare(ours, theirs, place) {
  if (theirs === undefined) fail(place, "is not in the published schema");
  for (const word of ["type", "title"])
    if (ours[word] !== undefined && ours[word] !== theirs[word]) fail(place, `${word} ${ours[word]} for ${theirs[word]}`);
  if (ours.type === "array") return compare_items(ours.items, theirs.items, place);
  for (const [name, property] of Object.entries(ours.properties ?? {})) compare(property, theirs.properties?.[name], `${place}.${name}`);
  if (ours.type !== "object") return;
  for (const name of theirs.required ?? [])
    if (!(ours.required ?? []).includes(name)) fail(place, `${name} is required`);
}
const is_open = (schema) => schema.type === "object" && Object.keys(schema.properties).length === 0;
function compare_items(ours, theirs, place) {
  if (ours.type !== theirs.type) fail(place, `items ${ours.type} for ${theirs.type}`);
  if (!is_open(ours)) compare(ours, theirs, `${place}[]`);
}

const fits = {
  object: (value) => typeof value === "object" && value !== null && !Array.isArray(value),
  array: Array.isArray,
  string: (value) => typeof value === "string",
  boolean: (value) => typeof value === "boolean",
  number: (value) => typeof value === "number",
  integer: Number.isInteger,
};
function validate(value, schema, place) {
  if (!fits[schema.type](value)) fail(place, `${JSON.stringify(value)} is no ${schema.type}`);
  if (value < schema.minimum || value > schema.maximum) fail(place, `${value} is out of range`);
  for (const name of schema.required ?? []) if (!(name in value)) fail(place, `${name} is missing`);
  if (schema.type === "array") value.forEach((item, i) => validate(item, schema.items, `${place}[${i}]`));
  if (schema.type !== "object") return;
  for (const [name, member] of Object.entries(value)) {
    if (schema.properties[name] === undefined) fail(place, `${name} is not in the schema`);
    validate(member, schema.properties[name], `${place}.${name}`);
  }
}

const digits = (number) => (Object.is(number, -0) ? "-0" : number.toPrecision(17));
const xyz = (a) => [a.x, a.y, a.z].map(digits);
const wxyz = (q) => [q.w, q.x, q.y, q.z].map(digits);
const print = (...fields) => console.log(fields.join("\t"));

function print_transforms(message, time) {
  for (const { timestamp, parent_frame_id, child_frame_id, translation, rotation } of message.transforms)
    print("transform", time, timestamp.sec, timestamp.nsec, parent_frame_id, child_frame_id, ...xyz(translation), ...wxyz(rotation));
}

function print_scene(message, time) {
  for (const entity of message.entities) {
    const { timestamp, id, frame_id, frame_locked, lifetime } = entity;
    print("entity", time, timestamp.sec, timestamp.nsec, id, frame_id, frame_locked, lifetime.sec + lifetime.nsec * 1e-9);
    for (const { key, value } of entity.metadata) print(key, id, value);
    const placed = ({ pose, size }) => [...xyz(pose.position), ...wxyz(pose.orientation), ...xyz(size)];
    for (const cube of entity.cubes) print("cube", id, ...placed(cube));
    for (const sphere of entity.spheres) print("sphere", id, ...placed(sphere));
    for (const cylinder of entity.cylinders)
      print("cylinder", id, ...placed(cylinder), digits(cylinder.bottom_scale), digits(cylinder.top_scale));
    for (const { points, indices } of entity.triangles) {
      if (indices.some((index) => points[index] === undefined)) fail(id, "an index has no point");
      for (let i = 0; i < indices.length; i += 3) print("triangle", id, ...indices.slice(i, i + 3).flatMap((index) => xyz(points[index])));
    }
  }
}

const printers = { "foxglove.FrameTransforms": print_transforms, "foxglove.SceneUpdate": print_scene };
const [mode, path] = process.argv.slice(2);
const { schemas, channels, messages } = await contents(mode, path);
for (const { id, topic, schemaId } of channels.values()) {
  const schema = schemas.get(schemaId);
  if (!topic.startsWith("/")) continue;
  const mine = messages.filter((message) => message.channelId === id);
  print("topic", topic, schema.name, mine.length);
  const ours = json(schema.data);
  const theirs = published[schema.name.replace("foxglove.", "")];
  compare(ours, theirs, schema.name);
  for (const { data, logTime } of mine) {
    const message = json(data);
    validate(message, theirs, topic);
    printers[schema.name](message, logTime);
  }
}
