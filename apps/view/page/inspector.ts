// The body that is selected: where it is, what it is, what acts on it, live; and its fields in the file.
import type { Context, Part } from "./context.ts";
import { element, setText } from "./dom.ts";
import { makeFieldRows } from "./field_editor.ts";
import { formatNumber, formatUnit } from "./numbers.ts";
import { numbersOfContact, numbersOfPose, type Body, type FieldDescription, type PortDescription, type Snapshot } from "./protocol.ts";
import { makeValueRow } from "./trail_tree.ts";

export function makeInspector(context: Context): Part {
  const bodies = context.description.scene.bodies;
  const choice = element("select", { "aria-label": "body" }, element("option", { value: "" }, "no body selected"),
    ...bodies.map((body, index) => element("option", { value: index }, body.trail)));
  choice.addEventListener("change", () => context.select(choice.value === "" ? null : Number(choice.value)));
  const content = element("div", { class: "inspector" });
  let shown: Part | null = null;
  const show = (selected: number | null) => {
    shown?.dispose();
    choice.value = selected === null ? "" : String(selected);
    shown = selected === null ? null : inspect(context, bodies[selected], selected);
    content.replaceChildren(...(shown === null ? [element("p", { class: "quiet" }, "Double click a body in a camera, or choose one here.")] : [shown.element]));
  };
  const forget = context.onSelected(show);
  show(context.selected);
  return {
    element: element("div", { class: "pane" }, choice, content),
    dispose: () => {
      forget();
      shown?.dispose();
    },
  };
}

/// Rows of three or four numbers under each other, in columns.
function numbersTable(label: string, rows: { name: string; unit: string; count: number; digits?: 0 }[]): { table: HTMLElement; show(row: number, numbers: ArrayLike<number>): void } {
  const cells = rows.map((row) => Array.from({ length: row.count }, () => element("td", { class: "number" })));
  const table = element("table", { class: "values", "aria-label": label }, element("tbody", {}, ...rows.map((row, i) =>
    element("tr", {}, element("th", { scope: "row" }, row.name, " ", element("span", { class: "unit" }, formatUnit(row.unit))), ...cells[i],
      ...(row.count < 4 ? [element("td", { colspan: 4 - row.count })] : [])))));
  return { table, show: (row, numbers) => cells[row].forEach((cell, i) => setText(cell, rows[row].digits === 0 ? String(numbers[i]) : formatNumber(numbers[i], 4))) };
}

function inspect(context: Context, body: Body, index: number): Part {
  const still = numbersTable("mass", [
    { name: "mass", unit: "kg", count: 1 },
    { name: "centre of mass", unit: "m", count: 3 },
  ]);
  still.show(0, [body.mass]);
  still.show(1, body.center_of_mass);
  const carried = body.robot >= 0;
  const live = numbersTable("pose and contact", [
    { name: "position", unit: "m", count: 3 },
    { name: "orientation w x y z", unit: "", count: 4 },
    ...(carried ? [
      { name: "contact force", unit: "N", count: 3 },
      { name: "contacts", unit: "", count: 1, digits: 0 as const },
      { name: "deepest", unit: "m", count: 1 },
    ] : []),
  ]);
  const draw = (snapshot: Snapshot) => {
    const run = snapshot.subjects[0];
    if (run === undefined) return;
    const pose = run.poses.subarray(index * numbersOfPose, (index + 1) * numbersOfPose);
    live.show(0, pose.subarray(0, 3));
    live.show(1, pose.subarray(3));
    if (!carried) return;
    const force = [0, 0, 0];
    let count = 0, depth = 0;
    for (let at = 0; at < run.contacts.length; at += numbersOfContact) {
      if (run.contacts[at] !== index) continue;
      ++count;
      depth = Math.max(depth, run.contacts[at + 10]);
      for (let axis = 0; axis < 3; ++axis) force[axis] += run.contacts[at + 4 + axis];
    }
    live.show(2, force);
    live.show(3, [count]);
    live.show(4, [count > 0 ? depth : NaN]);
  };
  if (context.latest !== null) draw(context.latest);
  const forget = context.onSnapshot(draw);
  const joint = !carried ? (body.shapes.length > 0 ? "obstacle" : "ground") : body.joint === null ? "no joint" : `${body.joint} joint`;
  const parent = body.parent < 0 ? "" : ` on ${context.description.scene.bodies[body.parent].trail}`;
  const values = element("div", { class: "rows" });
  const fields = element("div", { class: "rows" });
  const rows: Part[] = [];
  let gone = false;
  const beginning = `${body.trail}.`;
  void Promise.allSettled([context.connection.request("trails", { pattern: `${beginning}**` }), context.connection.request("fields", {})]).then(([ports, all]) => {
    if (gone) return;
    const own = (each: PortDescription | FieldDescription) => each.trail.startsWith(beginning);
    if (ports.status === "fulfilled") rows.push(...ports.value.ports.filter(own).map((port) => makeValueRow(context, port, port.trail.slice(beginning.length))));
    values.append(...rows.map((row) => row.element));
    if (all.status === "fulfilled") fields.append(...makeFieldRows(context, all.value.fields.filter(own), beginning));
    if (fields.childElementCount > 0) fields.before(element("h3", {}, "parameters"));
  });
  return {
    element: element("div", {}, element("p", { class: "quiet" }, joint + parent), ...(carried ? [still.table] : []), live.table, element("h3", {}, "values"), values, fields),
    dispose: () => {
      gone = true;
      forget();
      rows.forEach((row) => row.dispose());
    },
  };
}
