// A part of the page that may take all of it: by a double click on its title, by its button, back by the same or by Escape.
import { iconButton, setIcon } from "./icons.ts";

/// Adds the button to the title of a part.
export function makeMaximisable(part: HTMLElement, title: HTMLElement): void {
  const maximise = (whole: boolean) => {
    part.classList.toggle("maximised", whole);
    setIcon(button, whole ? "restore" : "maximise", whole ? "as it was (Escape)" : "maximise");
    if (whole) document.addEventListener("keydown", onKey);
    else document.removeEventListener("keydown", onKey);
  };
  const onKey = (event: KeyboardEvent) => {
    if (!part.isConnected) document.removeEventListener("keydown", onKey);
    else if (event.key === "Escape" && !event.defaultPrevented) maximise(false);
  };
  const toggle = () => maximise(!part.classList.contains("maximised"));
  const button = iconButton("maximise", "maximise", toggle);
  title.append(button);
  title.addEventListener("dblclick", (event) => {
    if (!(event.target instanceof Element) || event.target.closest("button, summary, details") === null) toggle();
  });
}
