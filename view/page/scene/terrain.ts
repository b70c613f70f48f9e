// The ground: its tiles coloured by material, and their edges; which tile is under a point.
import {
  BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Mesh, type ShaderMaterial, ShadowMaterial, Vector3,
} from "three";
import type { Terrain } from "../protocol.ts";
import { mix, type Palette, tileColour } from "./colours.ts";
import { type Light, matteMaterial } from "./matte.ts";

/// Above this the edges of tiles would be a grey veil.
const mostEdges = 40_000;

export class Ground {
  readonly group = new Group();
  readonly materials: number[]; // that tiles have, ascending
  readonly reach: number; // of the farthest vertex from the world's origin [m]
  private readonly tiles: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly shadows: Mesh<BufferGeometry, ShadowMaterial>;
  private readonly edges: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly materialOfVertex: number[] = [];

  constructor(
    private readonly terrain: Terrain,
    light: Light,
  ) {
    const positions: number[] = [];
    const normals: number[] = [];
    const lines = new Map<string, [number, number]>();
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    for (const [material, ...corners] of terrain.tiles) {
      for (let k = 0; k < corners.length; ++k) {
        const [from, to] = [corners[k], corners[(k + 1) % corners.length]];
        lines.set(from < to ? `${from} ${to}` : `${to} ${from}`, [from, to]);
      }
      for (let k = 2; k < corners.length; ++k) {
        const triangle = [corners[0], corners[k - 1], corners[k]];
        [a, b, c].forEach((each, corner) => this.vertex(triangle[corner], each));
        const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
        for (const each of [a, b, c]) {
          positions.push(each.x, each.y, each.z);
          normals.push(normal.x, normal.y, normal.z);
          this.materialOfVertex.push(material);
        }
      }
    }
    this.materials = [...new Set(this.materialOfVertex)].sort((one, other) => one - other);
    let reach = 0;
    for (let k = 0; k < terrain.vertices.length / 3; ++k) reach = Math.max(reach, this.vertex(k, a).length());
    this.reach = reach;

    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(positions.length), 3));
    this.tiles = new Mesh(geometry, matteMaterial(light, true));
    this.shadows = new Mesh(geometry, new ShadowMaterial({ opacity: 0.22, polygonOffset: true, polygonOffsetFactor: 0.5 }));
    this.shadows.receiveShadow = true;

    const ends: number[] = [];
    if (lines.size <= mostEdges)
      for (const pair of lines.values()) for (const end of pair) ends.push(...terrain.vertices.slice(3 * end, 3 * end + 3));
    this.edges = new LineSegments(
      new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(ends), 3)),
      new LineBasicMaterial(),
    );
    this.group.add(this.tiles, this.shadows, this.edges);
  }
  private vertex(index: number, out: Vector3): Vector3 {
    return out.fromArray(this.terrain.vertices, 3 * index);
  }

  paint(palette: Palette): void {
    const colours = this.tiles.geometry.getAttribute("color");
    const ofMaterial = new Map(this.materials.map((each) => [each, tileColour(each, palette)]));
    this.materialOfVertex.forEach((material, k) => {
      const { r, g, b } = ofMaterial.get(material)!;
      colours.setXYZ(k, r, g, b);
    });
    colours.needsUpdate = true;
    this.edges.material.color.copy(mix(palette.tileEdge, palette.page, 0.35));
  }
  show(terrain: boolean, edges: boolean, shadows: boolean): void {
    this.tiles.visible = terrain;
    this.shadows.visible = terrain && shadows;
    this.edges.visible = terrain && edges;
  }

  /// The normal of the tile above or below a point; straight up off the tiles.
  normalAt(x: number, y: number): Vector3 {
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    const side = (from: Vector3, to: Vector3) => (to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x);
    for (const [, ...corners] of this.terrain.tiles) {
      for (let k = 2; k < corners.length; ++k) {
        this.vertex(corners[0], a);
        this.vertex(corners[k - 1], b);
        this.vertex(corners[k], c);
        if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0) return b.sub(a).cross(c.sub(a)).normalize();
      }
    }
    return new Vector3(0, 0, 1);
  }
  dispose(): void {
    for (const each of [this.tiles, this.shadows, this.edges]) {
      each.geometry.dispose();
      each.material.dispose();
    }
  }
}
