// What the program or the page has to say: a quiet line at the foot of the page, and a bar while
// there is no connection.
import { element, setText } from "./dom.ts";
import { iconButton } from "./icons.ts";

const shortTime = 6000; // ms that a note stays; warnings and errors stay until they are closed
const mostNotices = 4;

export class Notices {
  readonly element: HTMLElement;
  private readonly list = element("div", { class: "notice-list", role: "log", "aria-live": "polite" });
  private ended = "";
  private readonly lost = element("div", { class: "lost", role: "status" });

  constructor() {
    this.lost.hidden = true;
    this.element = element("div", { class: "notices" }, this.list, this.lost);
  }

  /// What has been said so far is of a run that may be begun anew.
  mark(): void {
    for (const each of this.list.children) each.classList.add("earlier");
  }
  /// It has been begun anew, perhaps from a repaired file: what was said of the one before holds no more.
  clearEarlier(): void {
    for (const each of this.list.querySelectorAll(".earlier")) each.remove();
  }

  add(level: "note" | "warning" | "error", text: string): void {
    for (const each of [...this.list.children])
      if (each.querySelector(".said")?.textContent === text) each.remove();
    const notice = element("div", { class: `notice ${level}` }, element("span", { class: text.includes("\n") ? "said verbatim" : "said" }, text), iconButton("close", "close", () => notice.remove()));
    this.list.append(notice);
    while (this.list.childElementCount > mostNotices) this.list.firstElementChild!.remove();
    if (level === "note") setTimeout(() => notice.remove(), shortTime);
  }

  /// The program has said that it ends; a line that is lost then is none to wait for.
  setEnded(reason: string): void {
    this.ended = reason;
  }

  setConnected(connected: boolean): void {
    if (connected) this.ended = "";
    this.lost.hidden = connected;
    setText(this.lost, connected ? "" : this.ended === "" ? "connection lost, trying again" : `the program has ended: ${this.ended}`);
  }
}
