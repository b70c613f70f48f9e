// Numbers as the page shows them: a fixed count of digits, so that what changes stays in its
// place; a true minus sign; a dash for what is not known.

export const unknown = "\u2013";
const minus = "\u2212";
const mostDigits = 4; // of a distance

/// Significant digits, zeros at the end kept; powers of ten outside 0.001 to a million.
export function formatNumber(value: number, digits = 5): string {
  if (Number.isNaN(value)) return unknown;
  if (!Number.isFinite(value)) return value > 0 ? "\u221e" : minus + "\u221e";
  const size = Math.abs(value);
  let text: string;
  if (size === 0) text = (0).toFixed(digits - 1);
  else if (size < 1e-3 || size >= 1e6) text = size.toExponential(digits - 1).replace("e+", "e");
  else text = size.toPrecision(digits).includes("e") ? size.toFixed(0) : size.toPrecision(digits);
  return (value < 0 ? minus : "") + text.replace("e-", "e" + minus);
}

/// A count of decimals that tells a range apart in about a thousand steps.
export function decimalsOfRange(least: number, greatest: number): number {
  const size = Math.max(Math.abs(least), Math.abs(greatest));
  if (!(size > 0) || !Number.isFinite(size)) return 3;
  return Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(size))));
}

/// The decimals, below 0 for tens and hundreds, with which multiples of a distance are written exactly: 2 for 0.25, -1 for 20.
export function decimalsOfMultiples(distance: number): number {
  const least = -Math.floor(Math.log10(distance) + 1e-9);
  for (let decimals = least; decimals < least + mostDigits; ++decimals) {
    const scaled = distance * 10 ** decimals;
    if (Math.abs(scaled - Math.round(scaled)) < 1e-6 * scaled) return decimals;
  }
  return least + mostDigits;
}

/// Multiples of a distance, as an axis has them: alike, with the decimals that they take and no more; powers of ten for the very large
/// and small.
export function formatMultiples(values: (number | null)[]): string[] {
  const known = values.filter((value): value is number => value !== null);
  const distance = known.length > 1 ? Math.abs(known[1] - known[0]) : Math.abs(known[0] ?? 0) || 1;
  const size = Math.max(...known.map(Math.abs), distance);
  const decimals = decimalsOfMultiples(distance);
  const far = size >= 1e5 || distance < 1e-4;
  const zero = (value: number) => Math.abs(value) < 1e-9 * distance;
  const powers = (value: number) => value.toExponential(Math.min(20, Math.max(0, Math.floor(Math.log10(Math.abs(value)) + 1e-9) + decimals))).replace("e+", "e");
  const text = (value: number) => (zero(value) ? "0" : far ? powers(value) : value.toFixed(Math.max(0, decimals)));
  return values.map((value) => (value === null ? "" : text(value).replaceAll("-", minus)));
}

/// A range so wide that its places are told apart by factors: three decades or more, above 0.
export function spansDecades(least: number, greatest: number): boolean {
  return least > 0 && greatest >= 1000 * least * (1 - 1e-12);
}

export function formatDecimals(value: number, decimals: number): string {
  if (!Number.isFinite(value)) return formatNumber(value);
  const text = Math.abs(value).toFixed(decimals);
  return (value < 0 && Number(text) !== 0 ? minus : "") + text;
}

/// The decimals at which every step of the time is another number.
export function decimalsOfTime(deltat: number): number {
  return deltat > 0 && deltat < 1 ? Math.min(6, Math.ceil(-Math.log10(deltat) - 1e-9)) : 0;
}

/// What a person typed, or null where it is no number. A true minus sign and a decimal comma are taken.
export function parseNumber(text: string): number | null {
  const plain = text.trim().replace(minus, "-").replace(/^([+-]?\d*),(\d+)$/, "$1.$2");
  const value = Number(plain);
  return plain === "" || !Number.isFinite(value) ? null : value;
}

/// The unit of the language as it is printed: N.m as N\u00b7m, m/s^2 with a raised 2.
export function formatUnit(unit: string): string {
  const raised: Record<string, string> = { "-": "\u207b", "0": "\u2070", "1": "\u00b9", "2": "\u00b2", "3": "\u00b3", "4": "\u2074" };
  return unit
    .replace(/\./g, "\u00b7")
    .replace(/\^(-?[0-4])/g, (_, power: string) => [...power].map((each) => raised[each]).join(""));
}

const prefixes: [number, string][] = [[1e-3, "m"], [1e-6, "\u00b5"], [1e-9, "n"], [1e-12, "p"]];
const leastPlain = 1e-2; // from here on a value has the unit as it is

/// The unit in which values of this size are read without powers of ten: mm and um for metres. A value is divided by `factor`.
export function engineering(size: number, unit: string): { factor: number; unit: string } {
  const plain = { factor: 1, unit: formatUnit(unit) };
  if (!(size > 0 && size < leastPlain) || !/^(m|s|N|J|W|Pa)(?![\^A-Za-z])/.test(unit)) return plain;
  const [factor, prefix] = prefixes.find(([least]) => size >= least * (1 - 1e-9)) ?? prefixes[prefixes.length - 1];
  return { factor, unit: prefix + plain.unit };
}

/// A speed as a factor of real time.
export function formatSpeed(factor: number): string {
  if (factor === 0) return "as fast as possible";
  if (factor < 1) return `1/${Number((1 / factor).toPrecision(4))}`;
  return `${Number(factor.toPrecision(4))}`;
}
