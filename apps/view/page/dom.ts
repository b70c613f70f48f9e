// Making elements.

type Attributes = Record<string, string | number | boolean | null>;
type Child = Node | string;

/// An element with attributes (true: present, false or null: absent) and children.
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag, attributes: Attributes = {}, ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  setAttributes(made, attributes);
  made.append(...children);
  return made;
}

const svgSpace = "http://www.w3.org/2000/svg";

export function svgElement<Tag extends keyof SVGElementTagNameMap>(
  tag: Tag, attributes: Attributes = {}, ...children: Child[]
): SVGElementTagNameMap[Tag] {
  const made = document.createElementNS(svgSpace, tag);
  setAttributes(made, attributes);
  made.append(...children);
  return made;
}

function setAttributes(of: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes))
    if (value === true) of.setAttribute(name, "");
    else if (value !== false && value !== null) of.setAttribute(name, String(value));
}

/// Writes a text only where it is another: an unchanged one costs no layout.
export function setText(of: Element, text: string): void {
  if (of.textContent !== text) of.textContent = text;
}

let lastId = 0;
export function freshId(): string {
  return `id${++lastId}`;
}

/// A value of the style, such as a colour, as it is in the theme that is shown.
export function styleValue(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function isTyping(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement) return target.type !== "range" && target.type !== "checkbox" && target.type !== "radio";
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement || target.isContentEditable;
}

/// Gives a file to the user's browser to keep.
export function download(name: string, content: Blob): void {
  const link = element("a", { href: URL.createObjectURL(content), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/// To the clipboard, which a page that comes from another machine over HTTP may not use directly.
export async function copyText(text: string): Promise<void> {
  if (navigator.clipboard !== undefined) return navigator.clipboard.writeText(text);
  const area = element("textarea", { class: "unseen" });
  area.value = text;
  document.body.append(area);
  area.select();
  const copied = document.execCommand("copy");
  area.remove();
  if (!copied) throw new Error("this browser lets the page copy nothing");
}
