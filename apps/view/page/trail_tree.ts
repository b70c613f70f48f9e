// The tree of all values of a run: to read, to plot and, where wires may write, to set. Branches
// are made when they are opened, so that a robot of many legs costs nothing.
import { attempt, type Context, type Part } from "./context.ts";
import { element, setText } from "./dom.ts";
import { iconButton } from "./icons.ts";
import { formatDecimals, formatNumber, formatUnit, parseNumber } from "./numbers.ts";
import type { PortDescription } from "./protocol.ts";

const mostFound = 200;

export interface Branch {
  name: string;
  port: PortDescription | null;
  children: Map<string, Branch>;
}

/// Trails by their parts.
export function branchesOf(ports: PortDescription[]): Branch {
  const root: Branch = { name: "", port: null, children: new Map() };
  for (const port of ports) {
    let at = root;
    for (const name of port.trail.split(".")) {
      let next = at.children.get(name);
      if (next === undefined) at.children.set(name, (next = { name, port: null, children: new Map() }));
      at = next;
    }
    at.port = port;
  }
  return root;
}

/// What belongs to the page and not to the experiment stands behind it, in a branch of its own.
export function sorted(root: Branch, ofPage: (name: string) => boolean): Branch {
  const page: Branch = { name: "windows and subjects", port: null, children: new Map() };
  const children = new Map<string, Branch>();
  for (const [name, child] of root.children) (ofPage(name) ? page.children : children).set(name, child);
  if (page.children.size > 0) children.set(page.name, page);
  return { ...root, children };
}

/// A value that is watched while its row is on the page: name, number, unit, what can be done with it.
export function makeValueRow(context: Context, port: PortDescription, name: string): Part {
  const number = element("span", { class: "number" });
  // Counts and switches have no unit and no decimals.
  const unwatch = context.values.watch(port.trail, (value) =>
    setText(number, port.unit === "" && Number.isInteger(value) && Math.abs(value) < 1e9 ? formatDecimals(value, 0) : formatNumber(value)));
  const plot = iconButton("plot", `plot ${port.trail}`, () => context.plot({ x: null, y: port.trail, label: port.trail, unit: port.unit, x_unit: "s" }));
  const row = element("div", { class: "value-row", "data-trail": port.trail, title: port.doc === "" ? port.trail : `${port.trail}: ${port.doc}` },
    element("span", { class: "name" }, name), number, element("span", { class: "unit" }, formatUnit(port.unit)), plot);
  if (port.writable) {
    const field = element("input", { type: "text", inputmode: "decimal", class: "number", placeholder: "set", "aria-label": `set ${port.trail}` });
    field.addEventListener("change", () => {
      const value = parseNumber(field.value);
      field.setAttribute("aria-invalid", String(value === null));
      if (value === null) return;
      attempt(context, context.setter.set(port.trail, value));
      field.value = "";
    });
    number.after(field);
    row.classList.add("writable");
  }
  return { element: row, dispose: unwatch };
}

export function makeTrailTree(context: Context): Part {
  const search = element("input", { type: "search", placeholder: "search", "aria-label": "search in all values" });
  const body = element("div", { class: "tree", role: "group", "aria-label": "all values" });
  let ports: PortDescription[] = [];
  let rows: Part[] = [];
  const windows = new Set(context.description.windows.map((each) => each.trail.split(".")[0]));
  const ofPage = (name: string) => windows.has(name) || /^Subjects\[/.test(name);
  const opened = (context.kept.get("tree") as Set<string> | undefined) ?? new Set<string>();
  context.kept.set("tree", opened);

  function show(): void {
    rows.forEach((row) => row.dispose());
    rows = [];
    const wanted = search.value.trim().toLowerCase();
    if (wanted === "") {
      body.replaceChildren(...branch(sorted(branchesOf(ports), ofPage), "", rows));
      return;
    }
    const words = wanted.split(/\s+/);
    const found = ports.filter((port) => words.every((word) => port.trail.toLowerCase().includes(word)));
    rows = found.slice(0, mostFound).map((port) => makeValueRow(context, port, port.trail));
    const more = found.length > mostFound ? `the first ${mostFound} of ${found.length}` : found.length === 0 ? "nothing of that name" : "";
    body.replaceChildren(...rows.map((row) => row.element), ...(more === "" ? [] : [element("p", { class: "quiet" }, more)]));
  }

  function branch(of: Branch, trail: string, into: Part[]): HTMLElement[] {
    return [...of.children.values()].flatMap((child) => {
      const path = trail === "" ? child.name : `${trail}.${child.name}`;
      const made: HTMLElement[] = [];
      if (child.port !== null) {
        const row = makeValueRow(context, child.port, child.name);
        into.push(row);
        made.push(row.element);
      }
      if (child.children.size > 0) made.push(folder(child, path, into));
      return made;
    });
  }

  function folder(of: Branch, path: string, into: Part[]): HTMLElement {
    const inside: Part[] = [];
    const content = element("div", { class: "branch" });
    const details = element("details", {}, element("summary", {}, of.name), content);
    const close = () => inside.splice(0).forEach((row) => row.dispose());
    const follow = () => {
      close();
      content.replaceChildren(...(details.open ? branch(of, path, inside) : []));
      if (details.open) opened.add(path);
      else opened.delete(path);
    };
    details.addEventListener("toggle", follow);
    details.open = opened.has(path);
    into.push({ element: details, dispose: close });
    return details;
  }

  search.addEventListener("input", show);
  context.connection.request("trails", { pattern: "**" }).then((answer) => {
    ports = answer.ports;
    show();
  }, (refused: Error) => setText(body, refused.message));
  return {
    element: element("div", { class: "pane" }, search, body),
    dispose: () => rows.forEach((row) => row.dispose()),
  };
}
