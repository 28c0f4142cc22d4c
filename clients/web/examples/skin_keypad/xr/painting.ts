/** Text as textures, and rounded plates; everything in millimetres. */
import { CanvasTexture, LinearFilter, Mesh, MeshBasicMaterial, PlaneGeometry, Shape, SRGBColorSpace } from "./three_parts.js";

/** Enough for sharp text at reading distance in today's headsets (about 25 pixels a degree; 10 px/mm is twice that at 40 cm). */
const PX_PER_MM = 10;

export type Paint = (context: CanvasRenderingContext2D) => void;

/** A flat picture of `widthMm` x `heightMm`, painted with a canvas whose unit is a millimetre and whose origin is the middle. */
export class Painted extends Mesh<PlaneGeometry, MeshBasicMaterial> {
  readonly #canvas = document.createElement("canvas");

  constructor(widthMm: number, heightMm: number) {
    super(new PlaneGeometry(widthMm, heightMm), new MeshBasicMaterial({ transparent: true, depthWrite: false }));
    this.#canvas.width = Math.round(widthMm * PX_PER_MM);
    this.#canvas.height = Math.round(heightMm * PX_PER_MM);
    const texture = new CanvasTexture(this.#canvas);
    texture.colorSpace = SRGBColorSpace;
    texture.minFilter = LinearFilter;
    texture.generateMipmaps = false;
    this.material.map = texture;
  }

  paint(paint: Paint): this {
    const context = this.#canvas.getContext("2d");
    if (!context) throw new Error("this browser gives no 2-D canvas");
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.#canvas.width, this.#canvas.height);
    context.setTransform(PX_PER_MM, 0, 0, PX_PER_MM, this.#canvas.width / 2, this.#canvas.height / 2);
    paint(context);
    if (this.material.map) this.material.map.needsUpdate = true;
    return this;
  }

  dispose(): void {
    this.material.map?.dispose();
    this.material.dispose();
    this.geometry.dispose();
  }
}

/** A square with round corners around the origin. */
export function roundedSquare(size: number, corner: number): Shape {
  const half = size / 2;
  const inner = half - corner;
  const shape = new Shape();
  shape.moveTo(-inner, -half).lineTo(inner, -half).absarc(inner, -inner, corner, -Math.PI / 2, 0, false);
  shape.lineTo(half, inner).absarc(inner, inner, corner, 0, Math.PI / 2, false);
  shape.lineTo(-inner, half).absarc(-inner, inner, corner, Math.PI / 2, Math.PI, false);
  shape.lineTo(-half, -inner).absarc(-inner, -inner, corner, Math.PI, 1.5 * Math.PI, false);
  return shape;
}
