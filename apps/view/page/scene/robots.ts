// The bodies of one subject: surfaces, edges and outlines of all of them in three draw calls, placed by a texture of poses. The run
// itself is solid, with its obstacles; the others are ghosts: translucent, in their subject's colour.
import {
  BackSide, BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, FloatType, FrontSide, Group, type IUniform, LineSegments, type Matrix4, Mesh,
  MeshBasicMaterial, NearestFilter, Quaternion, RGBAFormat, ShaderMaterial, Vector2, Vector3,
} from "three";
import type { Body, Subject } from "../protocol.ts";
import { bodyColour, mix, obstacleColour, type Palette, robotColour } from "./colours.ts";
import { type Light, lighting, plainFragment, sunward } from "./matte.ts";
import { trianglesOf } from "./shapes.ts";

const ghostOpacity = 0.45;
const mostGhosts = 4; // of that opacity; more of them at one place cover no more than these do
const texels = 3; // of a body: place, orientation, colour

const placing = /* glsl */ `
attribute float body;
uniform highp sampler2D poses;
vec4 texel(int which) {
  return texelFetch(poses, ivec2(which, int(body + .5)), 0);
}
vec3 turned(vec3 v) {
  vec4 q = texel(1);
  return v + 2. * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}
vec4 placed() {
  return projectionMatrix * viewMatrix * vec4(texel(0).xyz + turned(position), 1.);
}`;
const surfaceShader = /* glsl */ `
${placing}
${lighting}
varying vec3 shade;
void main() {
  shade = lit(texel(2).rgb, turned(normal));
  gl_Position = placed();
}`;
/// Thrown along the sun's rays onto a plane. What is below it throws nothing.
const shadowShader = /* glsl */ `
${placing}
${lighting}
uniform vec3 corner, plane, shadow;
varying vec3 shade;
void main() {
  vec3 place = texel(0).xyz + turned(position);
  float height = max(dot(place - corner, plane), 0.);
  shade = lit(shadow, plane);
  gl_Position = projectionMatrix * viewMatrix * vec4(place - sun * (height / dot(sun, plane)), 1.);
  gl_Position.z -= 2e-5 * gl_Position.w;
}`;
const edgeShader = /* glsl */ `
${placing}
${lighting}
uniform vec3 colour;
varying vec3 shade;
void main() {
  shade = toDisplay(colour);
  gl_Position = placed();
}`;
/// An edge one and a half of the page's pixels wide: enough for the colours of many ghosts to be told apart by their edges.
const ribbonShader = /* glsl */ `
${placing}
${lighting}
attribute vec3 other;
attribute float side;
uniform vec2 resolution;
uniform float width;
uniform vec3 colour;
varying vec3 shade;
void main() {
  vec4 clip = placed();
  vec4 end = projectionMatrix * viewMatrix * vec4(texel(0).xyz + turned(other), 1.);
  vec2 along = (end.xy / end.w - clip.xy / clip.w) * resolution;
  if (length(along) > 1e-6) clip.xy += side * normalize(vec2(-along.y, along.x)) * 1.4 * width / resolution * clip.w;
  shade = toDisplay(colour);
  gl_Position = clip;
}`;
const outlineShader = /* glsl */ `
${placing}
${lighting}
attribute vec3 outline;
uniform vec2 resolution;
uniform float width;
uniform vec3 colour;
uniform vec3 selection;
uniform float selected;
varying vec3 shade;
void main() {
  vec4 clip = placed();
  bool marked = abs(body - selected) < .5;
  vec2 away = (projectionMatrix * viewMatrix * vec4(turned(outline), 0.)).xy * resolution;
  if (length(away) > 1e-6) clip.xy += normalize(away) * 2. * width * (marked ? 2.8 : 1.) / resolution * clip.w;
  shade = toDisplay(marked ? selection : colour);
  gl_Position = clip;
}`;

/// For picking and shadows; drawn in no colour.
const unseen = new MeshBasicMaterial({ colorWrite: false, depthWrite: false });

export class Robots {
  readonly group = new Group();
  readonly solids: Mesh[] = []; // a body's own shape; userData.body is its index
  private readonly poses: Float32Array;
  private readonly texture: DataTexture;
  private readonly layers: (Mesh<BufferGeometry, ShaderMaterial> | LineSegments<BufferGeometry, ShaderMaterial>)[] = [];
  private readonly uniforms: Record<string, IUniform>;
  private shadow: Mesh<BufferGeometry, ShaderMaterial> | null = null;
  private readonly links: number[] = []; // from each body to its base
  private readonly ghost: boolean;

  constructor(
    private readonly bodies: Body[],
    private readonly subject: Subject,
    index: number,
    light: Light,
    private readonly ghosts: number, // how many there are
  ) {
    this.ghost = index > 0;
    for (const body of bodies) this.links.push(body.parent < 0 ? 0 : this.links[body.parent] + 1);
    const opacity = 1 - (1 - ghostOpacity) ** Math.min(1, mostGhosts / Math.max(1, ghosts));
    this.poses = new Float32Array(Math.max(1, bodies.length) * texels * 4);
    this.texture = new DataTexture(this.poses, texels, Math.max(1, bodies.length), RGBAFormat, FloatType);
    this.texture.minFilter = this.texture.magFilter = NearestFilter;
    this.uniforms = {
      ...light.uniforms,
      poses: { value: this.texture },
      opacity: { value: this.ghost ? opacity : 1 },
      colour: { value: new Color() },
      selection: { value: new Color() },
      selected: { value: -1 },
      resolution: { value: new Vector2(1, 1) },
      width: { value: 1 },
      corner: { value: new Vector3() },
      plane: { value: new Vector3(0, 0, 1) },
      shadow: { value: new Color() },
    };
    this.build();
    // One after the other, so that the ghosts' surfaces mix in the same order in every frame.
    for (const layer of this.layers) {
      layer.frustumCulled = false;
      layer.renderOrder = this.ghost ? 10 + index : 0;
    }
    this.group.add(...this.layers);
  }
  private build(): void {
    const [positions, normals, outlines, bodyOf, indices]: number[][] = [[], [], [], [], []];
    const [ends, bodyOfEnd]: number[][] = [[], []];
    this.bodies.forEach((body, k) => {
      if (body.shapes.length === 0 || (this.ghost && body.robot < 0)) return;
      const triangles = trianglesOf(body.shapes);
      const first = positions.length / 3;
      for (const index of triangles.indices) indices.push(first + index);
      for (const each of triangles.positions) positions.push(each);
      for (const each of triangles.normals) normals.push(each);
      for (const each of triangles.outline) outlines.push(each);
      while (bodyOf.length < positions.length / 3) bodyOf.push(k);
      for (const each of triangles.edges) ends.push(each);
      while (bodyOfEnd.length < ends.length / 3) bodyOfEnd.push(k);
      if (this.ghost) return;
      const solid = new Mesh(triangles.mesh(), unseen);
      solid.userData.body = k;
      solid.matrixAutoUpdate = false;
      solid.castShadow = true;
      this.solids.push(solid);
      this.group.add(solid);
    });
    const surfaces = new BufferGeometry();
    for (const [name, numbers, size] of [["position", positions, 3], ["normal", normals, 3], ["outline", outlines, 3], ["body", bodyOf, 1]] as const)
      surfaces.setAttribute(name, new BufferAttribute(new Float32Array(numbers), size));
    surfaces.setIndex(indices);
    const { uniforms } = this;
    const common = { fragmentShader: plainFragment, uniforms };
    // Behind its edges; a ghost stands before the run where both are at the same place.
    const offset = { polygonOffset: !this.ghost, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
    const glassy = { transparent: this.ghost, depthWrite: !this.ghost };
    this.layers.push(new Mesh(surfaces, new ShaderMaterial({ ...common, ...offset, ...glassy, vertexShader: surfaceShader, side: FrontSide })));
    if (this.ghost) {
      // As solid as the run's: they tell where it is. It has no outline, which would show through.
      const opaque = { ...uniforms, opacity: { value: 1 } };
      this.layers.push(
        new Mesh(ribbons(ends, bodyOfEnd), new ShaderMaterial({ ...common, transparent: true, vertexShader: ribbonShader, uniforms: opaque, side: DoubleSide })));
      return;
    }
    this.shadow = new Mesh(surfaces, new ShaderMaterial({ ...common, vertexShader: shadowShader, side: DoubleSide }));
    this.shadow.frustumCulled = false;
    this.shadow.renderOrder = -0.5;
    this.group.add(this.shadow);
    const edges = new BufferGeometry();
    edges.setAttribute("position", new BufferAttribute(new Float32Array(ends), 3));
    edges.setAttribute("body", new BufferAttribute(new Float32Array(bodyOfEnd), 1));
    this.layers.push(new LineSegments(edges, new ShaderMaterial({ ...common, vertexShader: edgeShader })));
    this.layers.push(new Mesh(surfaces, new ShaderMaterial({ ...common, vertexShader: outlineShader, side: BackSide })));
  }

  paint(palette: Palette, selection: Color): void {
    this.uniforms.colour.value.copy(this.ghost ? mix(this.subject.colour, palette.ink, 0.25) : palette.edge);
    this.uniforms.selection.value.copy(selection);
    this.bodies.forEach((body, k) => {
      this.colour(body, k, palette).toArray(this.poses, (texels * k + 2) * 4);
    });
    this.texture.needsUpdate = true;
  }
  private colour(body: Body, k: number, palette: Palette): Color {
    if (this.ghost) return new Color(this.subject.colour);
    if (body.material !== null) return obstacleColour(body.material, palette);
    return bodyColour(this.ghosts > 0 ? this.subject.colour : robotColour(this.subject.colour, body.robot), this.links[k], palette);
  }
  select(body: number): void {
    this.uniforms.selected.value = body;
  }
  /// Picture's size [pixels], and pixels of the device to one of the page.
  size(width: number, height: number, scale: number): void {
    this.uniforms.resolution.value.set(width, height);
    this.uniforms.width.value = 1.1 * scale;
  }
  /// `flat`: a plane onto which the shapes throw a shadow of one tone, where shadows are not drawn in full.
  show(shapes: boolean, shadows: boolean, flat: { corner: Vector3; normal: Vector3; shade: Color } | null): void {
    if (this.shadow !== null) {
      this.shadow.visible = shapes && flat !== null && flat.normal.dot(sunward) > 0.2;
      if (flat !== null) {
        this.uniforms.corner.value.copy(flat.corner);
        this.uniforms.plane.value.copy(flat.normal);
        this.uniforms.shadow.value.copy(flat.shade);
      }
    }
    for (const layer of this.layers) layer.visible = shapes;
    for (const solid of this.solids) solid.visible = shapes && shadows;
  }
  pose(poses: Float64Array): void {
    this.bodies.forEach((_, k) => {
      const [from, to] = [7 * k, 4 * texels * k];
      this.poses[to] = poses[from];
      this.poses[to + 1] = poses[from + 1];
      this.poses[to + 2] = poses[from + 2];
      this.poses[to + 4] = poses[from + 4];
      this.poses[to + 5] = poses[from + 5];
      this.poses[to + 6] = poses[from + 6];
      this.poses[to + 7] = poses[from + 3];
    });
    this.texture.needsUpdate = true;
  }
  /// Places the solids, for picking and shadows.
  placeSolids(poses: Float64Array): void {
    for (const solid of this.solids) {
      placeMatrix(solid.matrix, poses, solid.userData.body as number);
      solid.matrixWorldNeedsUpdate = true;
    }
  }
  dispose(): void {
    for (const layer of this.layers) {
      layer.geometry.dispose();
      layer.material.dispose();
    }
    this.shadow?.material.dispose();
    for (const solid of this.solids) solid.geometry.dispose();
    this.texture.dispose();
  }
}

/// Lines from end to end as strips of two triangles, whose width the shader gives.
function ribbons(ends: number[], bodyOfEnd: number[]): BufferGeometry {
  const [positions, others, sides, bodies, indices]: number[][] = [[], [], [], [], []];
  for (let end = 0; end < bodyOfEnd.length; end += 2) {
    const [from, to] = [ends.slice(3 * end, 3 * end + 3), ends.slice(3 * end + 3, 3 * end + 6)];
    const first = positions.length / 3;
    // The way to the other end is the opposite one there, and so are its sides.
    for (const [at, other, side] of [[from, to, 1], [from, to, -1], [to, from, 1], [to, from, -1]] as const) {
      positions.push(...at);
      others.push(...other);
      sides.push(side);
      bodies.push(bodyOfEnd[end]);
    }
    indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
  const geometry = new BufferGeometry();
  for (const [name, numbers, size] of [["position", positions, 3], ["other", others, 3], ["side", sides, 1], ["body", bodies, 1]] as const)
    geometry.setAttribute(name, new BufferAttribute(new Float32Array(numbers), size));
  geometry.setIndex(indices);
  return geometry;
}

const position = new Vector3();
const orientation = new Quaternion();
const unit = new Vector3(1, 1, 1);

/// The matrix of body k from its pose, x y z qw qx qy qz.
export function placeMatrix(out: Matrix4, poses: Float64Array, body: number): Matrix4 {
  const at = 7 * body;
  position.set(poses[at], poses[at + 1], poses[at + 2]);
  orientation.set(poses[at + 4], poses[at + 5], poses[at + 6], poses[at + 3]);
  return out.compose(position, orientation, unit);
}
