// What sliders, dials, counters and inputs share: one number, wired to a port, that people and the
// run both move.
import { attempt, type Context } from "../context.ts";
import { decimalsOfMultiples, decimalsOfRange, parseNumber, spansDecades } from "../numbers.ts";
import type { Range, ValuatorWidget } from "../protocol.ts";

/// Significant digits of a number whose range spans decades.
export const digitsOfLogarithmic = 3;

/// Where a valuator reads its number and where it sets it.
export interface ValueLine {
  watch(listener: (value: number) => void): () => void;
  set(value: number): Promise<void>;
}

/// A port of the run.
export function lineOfPort(context: Context, port: string): ValueLine {
  return { watch: (listener) => context.values.watch(port, listener), set: (value) => context.setter.set(port, value) };
}

export class Valuator {
  value = NaN;
  readonly decimals: number;
  private range: Range;
  private held = false; // a person has it in hand
  private unanswered = 0;
  private unwatch = () => {};

  constructor(
    private readonly context: Context, readonly widget: ValuatorWidget, private readonly show: (value: number) => void,
    private readonly line = lineOfPort(context, widget.port),
  ) {
    this.range = widget.range ?? [-1, 1];
    this.decimals = widget.increment !== null && widget.increment > 0
      ? Math.max(0, decimalsOfMultiples(widget.increment))
      : decimalsOfRange(...this.range);
  }

  /// Shows the value, now and from now on.
  start(): void {
    this.show(this.value);
    this.unwatch = this.line.watch((value) => {
      if (this.held || this.unanswered > 0 || value === this.value) return;
      this.value = value;
      this.widen(value);
      this.show(value);
    });
  }

  get least(): number {
    return this.range[0];
  }
  get greatest(): number {
    return this.range[1];
  }
  /// Whether equal ways are equal factors.
  get logarithmic(): boolean {
    return spansDecades(...this.range);
  }
  /// A value as it is written, "" where it is not known.
  text(value: number): string {
    if (Number.isNaN(value)) return "";
    return this.logarithmic ? String(Number(value.toPrecision(digitsOfLogarithmic))) : value.toFixed(this.decimals);
  }
  get unit(): string {
    return this.widget.unit;
  }
  /// What a key or a press of a small button adds.
  get increment(): number {
    return this.widget.increment ?? (this.greatest - this.least) / 100;
  }

  hold(held: boolean): void {
    this.held = held;
  }

  /// Sets the port; the value that a person gave is shown until the program has taken or refused it.
  set(value: number): void {
    if (Number.isNaN(value) || this.context.description.kind === "movie") return;
    if (this.widget.range !== null) value = Math.min(this.greatest, Math.max(this.least, value));
    this.value = value;
    this.widen(value);
    this.show(value);
    ++this.unanswered;
    attempt(this.context, this.line.set(value).finally(() => {
      --this.unanswered;
    }));
  }

  dispose(): void {
    this.unwatch();
  }

  /// A valuator without a range follows its value: it reaches to twice of it.
  private widen(value: number): void {
    if (this.widget.range !== null || (value >= this.least && value <= this.greatest) || !Number.isFinite(value)) return;
    this.range = [Math.min(this.least, 2 * value), Math.max(this.greatest, 2 * value)];
  }
}

/// The number of a valuator as a field that can be typed into; Enter or leaving it sets.
export function wireNumberField(field: HTMLInputElement, valuator: Valuator): void {
  const show = () => {
    field.value = valuator.text(valuator.value);
  };
  const take = () => {
    const value = parseNumber(field.value);
    field.setAttribute("aria-invalid", String(value === null));
    if (value !== null) {
      valuator.set(value);
      show();
    }
  };
  field.addEventListener("focus", () => valuator.hold(true));
  field.addEventListener("change", take);
  field.addEventListener("keydown", (event) => {
    if (event.key === "Escape") {
      field.removeAttribute("aria-invalid");
      show();
      field.blur();
    }
  });
  field.addEventListener("blur", () => {
    valuator.hold(false);
    field.removeAttribute("aria-invalid");
    show();
  });
}
