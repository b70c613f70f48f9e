// The file's fields as text, each to be changed while the run goes on; what is wrong is told beside it.
import type { Context, Part } from "./context.ts";
import { element, setText } from "./dom.ts";
import { formatUnit } from "./numbers.ts";
import type { FieldDescription } from "./protocol.ts";

const mostShown = 300;

/// Rows of the fields, without the beginning of their trails.
export function makeFieldRows(context: Context, fields: FieldDescription[], beginning = ""): HTMLElement[] {
  return fields.map((field) => {
    const problem = element("span", { class: "problem", role: "alert" });
    const input = element("input", { type: "text", class: "field", "aria-label": field.trail, "data-trail": field.trail, value: field.value, spellcheck: "false" });
    let accepted = field.value;
    input.addEventListener("change", () => {
      const value = input.value;
      context.connection.request("edit", { trail: field.trail, value }).then(
        () => {
          accepted = value;
          input.removeAttribute("aria-invalid");
          setText(problem, "");
        },
        (refused: Error) => {
          input.setAttribute("aria-invalid", "true");
          setText(problem, refused.message);
        });
    });
    input.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      input.value = accepted;
      input.removeAttribute("aria-invalid");
      setText(problem, "");
    });
    return element("div", { class: "field-row", title: field.doc === "" ? field.trail : `${field.trail}: ${field.doc}` },
      element("span", { class: "name" }, field.trail.startsWith(beginning) ? field.trail.slice(beginning.length) : field.trail),
      input, element("span", { class: "unit" }, formatUnit(field.unit)), problem);
  });
}

export function makeFieldEditor(context: Context): Part {
  const search = element("input", { type: "search", placeholder: "search", "aria-label": "search in all parameters" });
  const body = element("div", { class: "fields" });
  let fields: FieldDescription[] = [];
  const show = () => {
    const words = search.value.trim().toLowerCase().split(/\s+/);
    const found = fields.filter((field) => words.every((word) => field.trail.toLowerCase().includes(word)));
    const more = found.length > mostShown ? `the first ${mostShown} of ${found.length}: search for the others` : found.length === 0 ? "no parameter of that name" : "";
    body.replaceChildren(...makeFieldRows(context, found.slice(0, mostShown)), ...(more === "" ? [] : [element("p", { class: "quiet" }, more)]));
  };
  search.addEventListener("input", show);
  context.connection.request("fields", {}).then((answer) => {
    fields = answer.fields;
    show();
  }, (refused: Error) => setText(body, refused.message));
  return { element: element("div", { class: "pane" }, search, body), dispose: () => {} };
}
