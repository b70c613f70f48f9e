// What the bar offers for the arrangement of the page: columns of plots, saving it into the file, back to what the file says.
import { attempt, type Context } from "./context.ts";
import { download, element, freshId } from "./dom.ts";
import { icon } from "./icons.ts";
import { fieldsFor, mostColumns } from "./layout.ts";

export function makeLayoutMenu(context: Context): HTMLElement {
  const { layout, description, connection } = context;
  const id = freshId();
  const columns = element("select", { id }, element("option", { value: "" }, "as many as have room"),
    ...Array.from({ length: mostColumns }, (_, i) => element("option", { value: i + 1 }, String(i + 1))));
  columns.addEventListener("change", () => layout.change({ columns: columns.value === "" ? null : Number(columns.value) }));
  const show = () => (columns.value = String(layout.now.columns ?? ""));
  show();

  const button = (text: string, title: string, press: () => void) => {
    const made = element("button", { type: "button", class: "press", title }, text);
    made.addEventListener("click", press);
    return made;
  };
  const save = button("save as .hook", "the file with its windows arranged as they are here", () => attempt(context, (async () => {
    const fields = fieldsFor(layout.now, description.windows, description.subjects.length > 1);
    if (layout.now.share !== null && !fields.some((each) => each.field === "width"))
      context.notice("warning", "the width of the scene is not saved: give its Window a name in the file");
    for (const { trail, field, value } of fields) await connection.request("edit", { trail: `${trail}.${field}`, value });
    const patch = await connection.request("patch", {});
    download(patch.name, new Blob([patch.text], { type: "text/plain" }));
  })()));
  const reset = button("as in the file", "forget how the page was arranged in this browser", () => {
    layout.reset();
    show();
  });
  const own = description.kind === "run" && description.windows.length > 0;
  return element("details", { class: "menu" }, element("summary", { class: "iconic", title: "layout", "aria-label": "layout" }, icon("layout")),
    element("div", { class: "menu-body" },
      element("label", { for: id }, "columns of plots"), columns,
      element("div", { class: "menu-buttons" }, ...(own ? [save] : []), reset)));
}
