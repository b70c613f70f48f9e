// The bodies of one subject. The run itself is solid; the others are ghosts: translucent, in their subject's colour.
import {
  BackSide, type BufferGeometry, Color, FrontSide, Group, LineBasicMaterial, LineSegments, type Matrix4, Mesh, MeshLambertMaterial, Quaternion,
  ShaderMaterial, Vector2, Vector3,
} from "three";
import type { Body, Subject } from "../protocol.ts";
import { bodyColour, mix, type Palette } from "./colours.ts";
import { trianglesOf } from "./shapes.ts";

const outlineShader = /* glsl */ `
attribute vec3 outline;
uniform vec2 resolution;
uniform float width;
void main() {
  vec4 clip = projectionMatrix * modelViewMatrix * vec4(position, 1.);
  vec2 away = (projectionMatrix * vec4(normalMatrix * outline, 0.)).xy * resolution;
  if (length(away) > 1e-6) clip.xy += normalize(away) * 2. * width / resolution * clip.w;
  gl_Position = clip;
}`;
const outlineColour = /* glsl */ `
uniform vec3 colour;
void main() {
  gl_FragColor = vec4(colour, 1.);
  #include <colorspace_fragment>
}`;

interface Part {
  body: number;
  surface: Mesh<BufferGeometry, MeshLambertMaterial>;
  edges: LineSegments<BufferGeometry, LineBasicMaterial>;
  outline: Mesh<BufferGeometry, ShaderMaterial> | null; // ghosts have none: it would show through
}

export class Robots {
  readonly group = new Group();
  readonly surfaces: Mesh[] = []; // to pick from; userData.body is the body's index
  private readonly parts: Part[] = [];
  private readonly ghost: boolean;
  private selected = -1;
  private scale = 1;
  private readonly resolution = new Vector2(1, 1);
  private readonly edgeMaterial: LineBasicMaterial;

  constructor(
    bodies: Body[],
    private readonly subject: Subject,
    index: number,
  ) {
    this.ghost = index > 0;
    this.edgeMaterial = new LineBasicMaterial();
    bodies.forEach((body, k) => {
      if (body.shapes.length === 0) return;
      const triangles = trianglesOf(body.shapes);
      const geometry = triangles.mesh();
      const material = new MeshLambertMaterial({
        side: FrontSide,
        transparent: this.ghost,
        opacity: this.ghost ? 0.45 : 1,
        depthWrite: !this.ghost,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
      });
      const surface = new Mesh(geometry, material);
      surface.userData.body = k;
      surface.castShadow = !this.ghost;
      surface.receiveShadow = !this.ghost;
      const edges = new LineSegments(triangles.lines(), this.edgeMaterial);
      const outline = this.ghost ? null : new Mesh(geometry, this.outlineMaterial());
      const part = { body: k, surface, edges, outline };
      for (const each of [surface, edges, outline]) {
        if (!each) continue;
        each.matrixAutoUpdate = false;
        // One after the other, so that the ghosts' surfaces mix in the same order in every frame.
        each.renderOrder = this.ghost ? 10 + index : 0;
        this.group.add(each);
      }
      this.surfaces.push(surface);
      this.parts.push(part);
    });
  }
  private outlineMaterial(): ShaderMaterial {
    return new ShaderMaterial({
      vertexShader: outlineShader,
      fragmentShader: outlineColour,
      side: BackSide,
      uniforms: { resolution: { value: this.resolution }, width: { value: 1 }, colour: { value: new Color() } },
    });
  }

  paint(palette: Palette, selection: Color): void {
    this.edgeMaterial.color.copy(this.ghost ? mix(this.subject.colour, palette.ink, 0.25) : palette.edge);
    for (const part of this.parts) {
      const colour = this.ghost ? new Color(this.subject.colour) : bodyColour(this.subject.colour, part.body, palette);
      part.surface.material.color.copy(colour);
      if (!part.outline) continue;
      const marked = part.body === this.selected;
      part.outline.material.uniforms.colour.value.copy(marked ? selection : palette.edge);
      part.outline.material.uniforms.width.value = (marked ? 3 : 1.1) * this.scale;
    }
  }
  select(body: number): void {
    this.selected = body;
  }
  /// Picture's size [pixels], and pixels of the device to one of the page.
  size(width: number, height: number, scale: number): void {
    this.resolution.set(width, height);
    for (const part of this.parts) {
      if (part.outline) part.outline.material.uniforms.width.value *= scale / this.scale;
    }
    this.scale = scale;
  }
  show(shapes: boolean): void {
    for (const part of this.parts) {
      part.surface.visible = shapes;
      part.edges.visible = shapes;
      if (part.outline) part.outline.visible = shapes;
    }
  }
  pose(poses: Float64Array): void {
    for (const part of this.parts) {
      placeMatrix(part.surface.matrix, poses, part.body);
      part.surface.matrixWorldNeedsUpdate = true;
      part.edges.matrix.copy(part.surface.matrix);
      part.edges.matrixWorldNeedsUpdate = true;
      if (!part.outline) continue;
      part.outline.matrix.copy(part.surface.matrix);
      part.outline.matrixWorldNeedsUpdate = true;
    }
  }
  dispose(): void {
    for (const part of this.parts) {
      part.surface.geometry.dispose();
      part.surface.material.dispose();
      part.edges.geometry.dispose();
      part.outline?.material.dispose();
    }
    this.edgeMaterial.dispose();
  }
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
