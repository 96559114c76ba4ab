// Lines several pixels wide whose points can change: the buffers grow when they must, and are reused otherwise.
import { InstancedInterleavedBuffer, InterleavedBufferAttribute } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";

export class WideLine extends LineSegments2 {
  /** @param {ConstructorParameters<typeof LineMaterial>[0]} style */
  constructor(style) {
    super(new LineSegmentsGeometry(), new LineMaterial(style));
    this.frustumCulled = false;
    this.buffer = new InstancedInterleavedBuffer(new Float32Array(0), 6, 1);
    this.reserve(1);
    this.segments = 0;
  }

  /** @param {number} segments */
  reserve(segments) {
    if (this.buffer.count >= segments) return;
    const { geometry: old } = this;
    this.geometry = new LineSegmentsGeometry(); // a buffer cannot be resized once it has been drawn
    this.buffer = new InstancedInterleavedBuffer(new Float32Array(6 * segments), 6, 1);
    this.geometry.setAttribute("instanceStart", new InterleavedBufferAttribute(this.buffer, 3, 0));
    this.geometry.setAttribute("instanceEnd", new InterleavedBufferAttribute(this.buffer, 3, 3));
    old.dispose();
  }

  set segments(count) {
    this.geometry.instanceCount = count;
    this.visible = count > 0;
  }

  // A polyline through n points; point(i, put) calls put(x, y, z).
  /** @param {number} n @param {Points} point */
  setPath(n, point) {
    this.setSegments(Math.max(n - 1, 0), (i, put) => {
      point(i, put);
      point(i + 1, put);
    });
  }

  // n separate segments; ends(i, put) calls put twice.
  /** @param {number} n @param {Points} ends */
  setSegments(n, ends) {
    this.reserve(n);
    const { array } = this.buffer;
    let at = 0;
    const put = (x, y, z) => {
      array[at++] = x;
      array[at++] = y;
      array[at++] = z;
    };
    for (let i = 0; i < n; i++) ends(i, put);
    this.buffer.needsUpdate = true;
    this.segments = n;
  }
}
