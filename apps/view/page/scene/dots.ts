// Marks of a given size in pixels, in one draw call, filled anew for every frame.
import { BufferAttribute, BufferGeometry, type Color, Points, ShaderMaterial } from "three";
import { GrowingBuffers } from "./growing_buffers.ts";

export type Mark = "disc" | "quartered" | "diamond" | "ring";
const marks: Mark[] = ["disc", "quartered", "diamond", "ring"];

const vertexShader = /* glsl */ `
attribute vec3 colour;
attribute float size;
uniform float scale;
varying vec3 shade;
varying float pixels;
varying float rimmed;
void main() {
  vec4 clip = projectionMatrix * modelViewMatrix * vec4(position, 1.);
  clip.z -= 4e-4 * clip.w;
  gl_Position = clip;
  gl_PointSize = size * scale;
  pixels = size * scale;
  rimmed = size - 5.;
  shade = colour;
}`;
const fragmentShader = /* glsl */ `
uniform int mark;
uniform vec3 rim;
varying vec3 shade;
varying float pixels;
varying float rimmed;
void main() {
  vec2 at = (gl_PointCoord - .5) * 2.;
  float reach = mark == 2 ? abs(at.x) + abs(at.y) : length(at);
  if (reach > 1.) discard;
  bool border = rimmed > 0. && reach > 1. - 2.6 / pixels;
  vec3 colour = border ? rim : shade;
  if (mark == 1 && !border) colour = at.x * at.y > 0. ? rim : shade;
  if (mark == 3) {
    if (reach < 1. - 3.2 / pixels) discard;
    colour = shade;
  }
  gl_FragColor = vec4(colour, 1.);
  #include <colorspace_fragment>
}`;

export class Dots {
  readonly points: Points<BufferGeometry, ShaderMaterial>;
  private readonly buffers: GrowingBuffers;

  constructor(mark: Mark, rim: Color, options: { onTop?: boolean; order?: number } = {}) {
    const material = new ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: { mark: { value: marks.indexOf(mark) }, rim: { value: rim }, scale: { value: 1 } },
      transparent: options.onTop === true,
      depthTest: options.onTop !== true,
      depthWrite: false,
    });
    this.points = new Points(new BufferGeometry(), material);
    this.points.frustumCulled = false;
    this.points.matrixAutoUpdate = false;
    this.points.renderOrder = options.order ?? 2;
    const names = ["position", "colour", "size"];
    this.buffers = new GrowingBuffers([3, 3, 1], (array, size) => new BufferAttribute(array, size), (attributes) => {
      this.points.geometry.dispose();
      this.points.geometry = new BufferGeometry();
      attributes.forEach((attribute, k) => this.points.geometry.setAttribute(names[k], attribute));
    });
  }
  begin(): void {
    this.buffers.begin();
  }
  add(x: number, y: number, z: number, colour: Color, size: number): void {
    const at = this.buffers.next();
    const [positions, colours, sizes] = this.buffers.attributes;
    positions.setXYZ(at, x, y, z);
    colours.setXYZ(at, colour.r, colour.g, colour.b);
    sizes.setX(at, size);
  }
  end(): void {
    this.buffers.end();
    this.points.geometry.setDrawRange(0, this.buffers.count);
    this.points.visible = this.buffers.count > 0;
  }
  scale(scale: number): void {
    this.points.material.uniforms.scale.value = scale;
  }
  dispose(): void {
    this.points.geometry.dispose();
    this.points.material.dispose();
  }
}
