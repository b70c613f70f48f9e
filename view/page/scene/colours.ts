// The scene's colours: those of the page (its CSS variables), light or dark, and what follows from them.
import { Color } from "three";

export interface Palette {
  dark: boolean;
  page: Color; // behind everything
  ink: Color;
  quiet: Color;
  warning: Color;
  edge: Color; // of shapes
  tileEdge: Color;
  typeFace: string;
}

const fallbacks = {
  light: { panel: "#ffffff", ink: "#1a1a1a", quiet: "#6b6b6b", warning: "#b3261e" },
  dark: { panel: "#1e2125", ink: "#e8e8e8", quiet: "#9a9a9a", warning: "#ff8a80" },
};

/// `probe` is an element of the page: a variable may hold any CSS colour, and only the browser knows which.
export function readPalette(probe: HTMLElement): Palette {
  const preferred = matchMedia("(prefers-color-scheme: dark)").matches ? fallbacks.dark : fallbacks.light;
  const read = (name: keyof typeof fallbacks.light): Color => {
    probe.style.color = `var(--${name}, ${preferred[name]})`;
    return cssColour(getComputedStyle(probe).color, preferred[name]);
  };
  const [page, ink, quiet, warning] = [read("panel"), read("ink"), read("quiet"), read("warning")];
  const dark = lightness(page) < 0.5;
  return {
    dark,
    page,
    ink,
    quiet,
    warning,
    edge: dark ? mix(page, "#000000", 0.5) : mix(ink, page, 0.1),
    tileEdge: mix(page, ink, dark ? 0.32 : 0.3),
    typeFace: getComputedStyle(probe).fontFamily || "sans-serif",
  };
}

function cssColour(text: string, fallback: string): Color {
  const wide = /^color\(srgb ([\d.e+-]+) ([\d.e+-]+) ([\d.e+-]+)/.exec(text);
  if (wide) return fromDisplay(Number(wide[1]), Number(wide[2]), Number(wide[3]));
  const plain = /^rgba?\(([\d.]+)[, ]+([\d.]+)[, ]+([\d.]+)/.exec(text);
  if (plain) return fromDisplay(Number(plain[1]) / 255, Number(plain[2]) / 255, Number(plain[3]) / 255);
  return new Color(fallback);
}

function fromDisplay(red: number, green: number, blue: number): Color {
  return new Color().setRGB(red, green, blue, "srgb");
}
function display(colour: Color): { r: number; g: number; b: number } {
  return colour.getRGB({ r: 0, g: 0, b: 0 }, "srgb");
}
export function lightness(colour: Color): number {
  const { r, g, b } = display(colour);
  return 0.299 * r + 0.587 * g + 0.114 * b;
}
/// Between two colours as the eye takes them: in display values, not in light.
export function mix(from: Color | string, to: Color | string, share: number): Color {
  const [a, b] = [display(new Color(from)), display(new Color(to))];
  return fromDisplay(a.r + (b.r - a.r) * share, a.g + (b.g - a.g) * share, a.b + (b.b - a.b) * share);
}
export function css(colour: Color): string {
  return `#${colour.getHexString("srgb")}`;
}

/// A robot's surface: its subject's colour, quiet enough for lines and forces to stand before it. Neighbouring bodies differ a little.
export function bodyColour(subject: string, body: number, palette: Palette): Color {
  const grey = palette.dark ? "#a8acb2" : "#d9dadc";
  const base = mix(subject, grey, palette.dark ? 0.55 : 0.62);
  return body % 2 === 0 ? base : mix(base, palette.dark ? "#000000" : "#ffffff", palette.dark ? 0.12 : 0.16);
}

const tileColours = {
  light: ["#e6e3dc", "#d3dccb", "#ccd8e2", "#e3d0c4", "#d9d0e0", "#e6ddb8", "#c9dbd9", "#d6d6d6"],
  dark: ["#3a3933", "#34462f", "#2b3d50", "#54382a", "#433753", "#524a22", "#24494a", "#3d4045"],
};
export function tileColour(material: number, palette: Palette): Color {
  const colours = palette.dark ? tileColours.dark : tileColours.light;
  return new Color(colours[material % colours.length]);
}

const depthColours = ["#fde725", "#7ad151", "#22a884", "#2a788e", "#414487", "#440154"];
/// Shallow is light and deep dark; on a dark page the other way round.
export function depthColour(share: number, palette: Palette): Color {
  const clamped = Math.min(Math.max(share, 0), 1);
  const at = (palette.dark ? 1 - clamped : clamped) * (depthColours.length - 1);
  const from = Math.min(Math.floor(at), depthColours.length - 2);
  return mix(depthColours[from], depthColours[from + 1], at - from);
}

export const axisColours = ["#c4442f", "#3d8c40", "#2f6fc4"]; // x y z
