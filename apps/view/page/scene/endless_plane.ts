// A plane without an end: a disc under what the camera looks at, with the lines of the tiles, that fades into the page towards the horizon.
import { BufferAttribute, BufferGeometry, Color, CircleGeometry, FrontSide, Mesh, ShaderMaterial, Vector3 } from "three";
import { type Light, lighting } from "./matte.ts";

/// Of the camera's distance: there the plane has become the page.
export const horizon = 36;
const segments = 64;

const vertexShader = /* glsl */ `
${lighting}
uniform vec3 corner, center, normal0, sideA, sideB, colour, lineColour, pageColour;
uniform float radius;
varying vec2 tile;
varying vec2 away;
varying vec3 shade, lineShade, pageShade;
void main() {
  vec3 along = normalize(sideA);
  vec3 across = cross(normal0, along);
  vec3 place = center + radius * (position.x * along + position.y * across);
  vec3 from = place - corner;
  float aa = dot(sideA, sideA), ab = dot(sideA, sideB), bb = dot(sideB, sideB);
  vec2 d = vec2(dot(from, sideA), dot(from, sideB));
  tile = vec2(bb * d.x - ab * d.y, aa * d.y - ab * d.x) / (aa * bb - ab * ab);
  away = position.xy;
  shade = lit(colour, normalize(mat3(modelMatrix) * normal0));
  lineShade = toDisplay(lineColour);
  pageShade = toDisplay(pageColour);
  gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(place, 1.);
}`;

/// A line is a pixel wide; where tiles come down to a few pixels, lines become a tone and vanish.
const fragmentShader = /* glsl */ `
uniform float lines;
varying vec2 tile;
varying vec2 away;
varying vec3 shade, lineShade, pageShade;
void main() {
  vec2 width = max(fwidth(tile), 1e-6);
  vec2 near = abs(fract(tile - .5) - .5) / width;
  vec2 line = clamp(1. - near, 0., 1.) * clamp(1. - 4. * width, 0., 1.);
  float distant = length(away);
  float far = smoothstep(.12, 1., distant);
  vec3 ground = mix(shade, lineShade, lines * max(line.x, line.y) * (1. - smoothstep(.05, .5, distant)));
  gl_FragColor = vec4(mix(ground, pageShade, sqrt(far)), 1.);
}`;

/// Through the corners of one of its tiles.
export class EndlessPlane {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  readonly normal = new Vector3();
  readonly corner: Vector3;

  constructor(light: Light, corner: Vector3, sideA: Vector3, sideB: Vector3) {
    this.corner = corner.clone();
    this.normal.crossVectors(sideA, sideB).normalize();
    const geometry = new BufferGeometry().setAttribute("position", new CircleGeometry(1, segments).getAttribute("position") as BufferAttribute);
    geometry.setIndex(new CircleGeometry(1, segments).getIndex());
    this.mesh = new Mesh(geometry, new ShaderMaterial({
      vertexShader, fragmentShader, side: FrontSide,
      uniforms: {
        ...light.uniforms, corner: { value: this.corner },
        center: { value: new Vector3() }, normal0: { value: this.normal }, sideA: { value: sideA.clone() }, sideB: { value: sideB.clone() },
        colour: { value: new Color() }, lineColour: { value: new Color() }, pageColour: { value: new Color() },
        radius: { value: 1 }, lines: { value: 1 },
      },
      polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 4,
    }));
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -1;
  }
  paint(colour: Color, line: Color, page: Color): void {
    const { uniforms } = this.mesh.material;
    uniforms.colour.value.copy(colour);
    uniforms.lineColour.value.copy(line);
    uniforms.pageColour.value.copy(page);
  }
  showLines(shown: boolean): void {
    this.mesh.material.uniforms.lines.value = shown ? 1 : 0;
  }
  /// Under a point that the camera looks at from `distance`, both in the plane's own axes. The lines stay where the tiles are.
  place(target: Vector3, distance: number): void {
    const { uniforms } = this.mesh.material;
    const height = under.subVectors(target, this.corner).dot(this.normal);
    uniforms.center.value.copy(target).addScaledVector(this.normal, -height);
    uniforms.radius.value = horizon * Math.max(distance, Math.abs(height));
  }
  /// Puts a disc of radius 1 flat onto the plane, where the plane itself is.
  lay(disc: Mesh, radius: number): void {
    disc.position.copy(this.mesh.material.uniforms.center.value);
    disc.quaternion.setFromUnitVectors(up, this.normal);
    disc.scale.setScalar(radius);
  }
  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}

const under = new Vector3();
const up = new Vector3(0, 0, 1);
