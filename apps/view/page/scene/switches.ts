// What a scene can show, each a switch of the camera.
export const switches = [
  "shapes",
  "terrain",
  "edges",
  "contact_forces",
  "hooks",
  "slip_traces",
  "penetration",
  "frames",
  "centers_of_mass",
  "inertia",
  "joint_axes",
  "sensors",
  "boundary_points",
] as const;

export type Switch = (typeof switches)[number];

/// What is shown where neither the file nor the user says.
export function defaultSwitches(): Record<Switch, boolean> {
  const shown: Switch[] = ["shapes", "terrain", "edges"];
  return Object.fromEntries(switches.map((each) => [each, shown.includes(each)])) as Record<Switch, boolean>;
}
