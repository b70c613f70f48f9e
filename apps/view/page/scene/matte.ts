// How surfaces are lit: matte, from the sky, the sun above and the viewer, at their corners. That is exact for flat faces and enough
// for round ones, and a machine that draws in software fills a picture with it several times faster than with a shader for each pixel.
import { FrontSide, type IUniform, ShaderMaterial, Vector3 } from "three";

/// Towards the sun, which stands still in the world: almost straight above.
export const sunward = new Vector3(-0.15, -0.1, 1).normalize();

/// Of one picture; its materials share them.
export class Light {
  readonly uniforms = { head: { value: new Vector3(0, 0, 1) } };
  /// Unit vector towards the viewer's lamp.
  get head(): Vector3 {
    return this.uniforms.head.value;
  }
}

export const lighting = /* glsl */ `
uniform vec3 head;
const vec3 sun = vec3(${sunward.toArray().map((each) => each.toFixed(6)).join(", ")});
vec3 toDisplay(vec3 light) {
  vec3 bounded = clamp(light, 0., 1.);
  return mix(12.92 * bounded, 1.055 * pow(max(bounded, 1e-5), vec3(1. / 2.4)) - .055, step(.0031308, bounded));
}
vec3 lit(vec3 colour, vec3 normal) {
  float sky = mix(.14, .52, .5 + .5 * normal.z);
  return toDisplay(colour * (sky + .32 * max(dot(normal, sun), 0.) + .3 * max(dot(normal, head), 0.)));
}`;

/// For colours that the vertex shader made ready for display.
export const plainFragment = /* glsl */ `
uniform float opacity;
varying vec3 shade;
void main() {
  gl_FragColor = vec4(shade, opacity);
}`;

const vertexShader = /* glsl */ `
${lighting}
varying vec3 shade;
void main() {
  mat4 place = modelMatrix;
  vec3 colour = vec3(1.);
#ifdef USE_INSTANCING
  place = place * instanceMatrix;
#endif
#ifdef USE_INSTANCING_COLOR
  colour = instanceColor;
#endif
#ifdef USE_COLOR
  colour = color;
#endif
  // Normals of a shape scaled along its axes.
  mat3 turn = mat3(place);
  turn[0] /= dot(turn[0], turn[0]);
  turn[1] /= dot(turn[1], turn[1]);
  turn[2] /= dot(turn[2], turn[2]);
  shade = lit(colour, normalize(turn * normal));
  gl_Position = projectionMatrix * viewMatrix * place * vec4(position, 1.);
}`;

/// A matte surface with colours of its vertices or instances.
export function matteMaterial(light: Light, vertexColors: boolean): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader: plainFragment,
    uniforms: { ...light.uniforms, opacity: { value: 1 } } as Record<string, IUniform>,
    vertexColors,
    side: FrontSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}
