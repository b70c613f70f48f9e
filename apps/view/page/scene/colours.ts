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
  materials: string[]; // names, by which the ground is coloured
}

const fallbacks = {
  light: { panel: "#ffffff", ink: "#1a1a1a", quiet: "#6b6b6b", warning: "#b3261e" },
  dark: { panel: "#1e2125", ink: "#e8e8e8", quiet: "#9a9a9a", warning: "#ff8a80" },
};

/// `probe` is an element of the page: a variable may hold any CSS colour, and only the browser knows which.
export function readPalette(probe: HTMLElement, materials: string[] = []): Palette {
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
    materials,
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

/// Of further robots beside the subject's own, where there is one subject.
const robotColours = ["#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f"];
export function robotColour(subject: string, robot: number): string {
  return robot <= 0 ? subject : robotColours[(robot - 1) % robotColours.length];
}

/// A robot's surface: its colour, quiet enough for lines and forces to stand before it; lighter from link to link away from the base.
export function bodyColour(colour: string, links: number, palette: Palette): Color {
  const grey = palette.dark ? "#a8acb2" : "#d9dadc";
  const base = mix(colour, grey, palette.dark ? 0.45 : 0.5);
  const lighter = Math.min(0.14 * links, 0.42);
  return mix(base, "#ffffff", palette.dark ? 0.6 * lighter : lighter);
}

/// What a name has in it, light, dark: ice is blue and moss is green.
const namedTiles: [RegExp, string, string][] = [
  [/ice|snow|water|wet/, "#cfe3f2", "#2c4254"],
  [/moss|grass|turf|lawn|field/, "#cfe0c3", "#2f4329"],
  [/sand|beach|gravel/, "#ecdfba", "#4d4427"],
  [/clay|soil|mud|earth|dirt|peat/, "#e2cbb9", "#4b3628"],
  [/wood|parquet|cork/, "#ead6b8", "#4a3b26"],
  [/rubber|mat|tyre|tar|asphalt/, "#c9ccd1", "#2c3036"],
  [/stone|rock|concrete|floor|tile|hard/, "#dddfe1", "#3a3e44"],
  [/metal|steel|iron|glass|rigid/, "#d3dbe3", "#333c46"],
  [/foam|soft|cushion|carpet/, "#e0d3e6", "#3e3449"],
];
const tileColours = {
  light: ["#e9e9e6", "#d8e2d0", "#d3dfe9", "#e8d7cb", "#dfd6e6", "#ebe3c2", "#d0e1df", "#dcdcdc"],
  dark: ["#2b2e32", "#2d3b2b", "#283848", "#46342a", "#3a3147", "#443e24", "#254142", "#35383d"],
};
export function tileColour(material: number, palette: Palette): Color {
  const name = palette.materials[material] ?? "";
  const named = namedTiles.filter(([words]) => words.test(name));
  const alike = palette.materials.filter((other) => named.length > 0 && namedTiles.find(([words]) => words.test(other)) === named[0]);
  const colours = palette.dark ? tileColours.dark : tileColours.light;
  if (named.length === 0) return new Color(colours[material % colours.length]);
  // Several of a kind differ a little.
  const base = named[0][palette.dark ? 2 : 1];
  return mix(base, palette.ink, 0.07 * Math.max(0, alike.indexOf(name)));
}

/// An obstacle's surface: its material's, darker than the ground beside it.
export function obstacleColour(material: number, palette: Palette): Color {
  return mix(tileColour(material, palette), palette.ink, palette.dark ? 0.16 : 0.2);
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
