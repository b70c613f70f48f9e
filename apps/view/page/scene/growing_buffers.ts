// Attributes of a geometry that are filled anew for every frame, and allocate only when a frame needs more than any before.
import { type BufferAttribute, DynamicDrawUsage } from "three";

export class GrowingBuffers {
  attributes: BufferAttribute[] = [];
  count = 0;
  private capacity = 0;

  /// `make` one attribute of so many numbers, and `replace` the geometry that has them: the buffers of a geometry stay as large as
  /// they were made.
  constructor(
    private readonly sizes: number[],
    private readonly make: (numbers: Float32Array, size: number) => BufferAttribute,
    private readonly replace: (attributes: BufferAttribute[]) => void,
  ) {
    this.grow(64);
  }
  private grow(capacity: number): void {
    const earlier = this.attributes;
    this.attributes = this.sizes.map((size, k) => {
      const attribute = this.make(new Float32Array(capacity * size), size).setUsage(DynamicDrawUsage);
      if (earlier[k]) attribute.array.set(earlier[k].array);
      return attribute;
    });
    this.capacity = capacity;
    this.replace(this.attributes);
  }
  begin(): void {
    this.count = 0;
  }
  /// The place of one more.
  next(): number {
    if (this.count === this.capacity) this.grow(2 * this.capacity);
    return this.count++;
  }
  /// To be sent to the graphics card: no more than was filled.
  end(): void {
    for (const attribute of this.attributes) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, this.count * attribute.itemSize);
      attribute.needsUpdate = this.count > 0;
    }
  }
}
