// The ground: its tiles coloured by material, and their edges; which tile is under a point.
import {
  BufferAttribute, BufferGeometry, CircleGeometry, Color, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, type ShaderMaterial, ShadowMaterial, Vector3,
} from "three";
import type { Terrain } from "../protocol.ts";
import { mix, type Palette, tileColour } from "./colours.ts";
import { EndlessPlane, horizon } from "./endless_plane.ts";
import { type Light, matteMaterial } from "./matte.ts";
import { placeMatrix } from "./robots.ts";

/// Above this the edges of tiles would be a grey veil.
const mostEdges = 40_000;

export class Ground {
  readonly group = new Group();
  readonly materials: number[]; // that tiles have, ascending
  readonly spacing: number; // of the tiles, as the first of them is [m]
  private readonly tiles: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly shadows: Mesh<BufferGeometry, ShadowMaterial>;
  private readonly edges: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly materialOfVertex: number[] = [];
  private readonly plane: EndlessPlane | null = null;
  private readonly shade = new Color(); // of a shadow
  private readonly tilesReach: number; // of the farthest vertex from the world's origin [m]

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
    this.tilesReach = reach;
    this.spacing = this.vertex(terrain.tiles[0]?.[2] ?? 0, a).distanceTo(this.vertex(terrain.tiles[0]?.[1] ?? 0, b));
    const [, first, second, third] = terrain.tiles[0] ?? [];
    if (terrain.endless !== null && terrain.endless !== undefined && third !== undefined) {
      this.vertex(first, a);
      this.vertex(second, b);
      this.vertex(third, c);
      this.plane = new EndlessPlane(light, a, b.clone().sub(a), c.sub(b));
    }

    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(positions.length), 3));
    this.tiles = new Mesh(geometry, matteMaterial(light, true));
    const shadows = new ShadowMaterial({ opacity: 0.22, polygonOffset: true, polygonOffsetFactor: 0.5 });
    this.shadows = new Mesh(this.plane === null ? geometry : new CircleGeometry(1, 48), shadows);
    this.shadows.receiveShadow = true;

    const ends: number[] = [];
    if (lines.size <= mostEdges)
      for (const pair of lines.values()) for (const end of pair) ends.push(...terrain.vertices.slice(3 * end, 3 * end + 3));
    this.edges = new LineSegments(
      new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(ends), 3)),
      new LineBasicMaterial(),
    );
    this.group.add(this.tiles, this.shadows, this.edges);
    if (this.plane !== null) this.group.add(this.plane.mesh);
    this.group.matrixAutoUpdate = false;
  }
  /// What a shadow falls on that is thrown onto a plane at once: a plane that stands still.
  get flat(): { corner: Vector3; normal: Vector3; shade: Color } | null {
    return this.plane === null || this.terrain.body >= 0 ? null : { corner: this.plane.corner, normal: this.plane.normal, shade: this.shade };
  }
  /// How far there is something to see of it from a camera at `distance` of what it looks at [m].
  reach(distance: number): number {
    return this.plane === null ? this.tilesReach : Math.max(this.tilesReach, horizon * distance);
  }
  /// Ground that moves is put where it is; one without an end is put under what the camera looks at.
  place(poses: Float64Array | null, target: Vector3, distance: number, surround: number): void {
    if (this.terrain.body >= 0 && poses !== null) {
      placeMatrix(this.group.matrix, poses, this.terrain.body);
      this.group.matrixWorldNeedsUpdate = true;
    }
    if (this.plane === null) return;
    under.copy(target);
    if (this.terrain.body >= 0) under.applyMatrix4(inverse.copy(this.group.matrix).invert());
    this.plane.place(under, distance);
    this.plane.lay(this.shadows, 6 * surround);
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
    const line = mix(palette.tileEdge, palette.page, 0.35);
    this.edges.material.color.copy(line);
    if (this.plane === null) return;
    const ground = tileColour(this.terrain.endless!, palette);
    this.plane.paint(ground, line, palette.page);
    this.shade.copy(mix(ground, "#000000", palette.dark ? 0.42 : 0.2));
  }
  show(terrain: boolean, edges: boolean, shadows: boolean): void {
    // Tiles of one material are the plane's own.
    const tiled = this.plane === null || this.materials.length > 1;
    this.tiles.visible = terrain && tiled;
    this.shadows.visible = terrain && shadows;
    this.edges.visible = terrain && edges && tiled;
    if (this.plane === null) return;
    this.plane.mesh.visible = terrain;
    this.plane.showLines(edges);
  }

  /// The normal of the tile above or below a point at the start; straight up off the tiles.
  normalAt(x: number, y: number): Vector3 {
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    const side = (from: Vector3, to: Vector3) => (to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x);
    for (const [, ...corners] of this.terrain.tiles) {
      for (let k = 2; k < corners.length; ++k) {
        this.vertex(corners[0], a);
        this.vertex(corners[k - 1], b);
        this.vertex(corners[k], c);
        if (side(a, b) < 0 || side(b, c) < 0 || side(c, a) < 0) continue;
        const normal = b.sub(a).cross(c.sub(a)).normalize();
        if (normal.z > 0) return normal; // no riser
      }
    }
    return new Vector3(0, 0, 1);
  }
  dispose(): void {
    this.plane?.dispose();
    for (const each of [this.tiles, this.shadows, this.edges]) {
      each.geometry.dispose();
      each.material.dispose();
    }
  }
}

const under = new Vector3();
const inverse = new Matrix4();
