/** One key in the headset: a cap over a dark well, which sinks and deepens in colour with the force. */
import type { ViewLook } from "../../../src/skin/index.js";
import { LETTERS } from "../words.js";
import { Painted, roundedSquare } from "./painting.js";
import { Color, ExtrudeGeometry, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial } from "./three_parts.js";

/** The hardest press that the model tells apart, in newtons. */
const FULL_FORCE_N = 3.5;
const CORNER_MM = 3.4;
const CAP_MM = 1.6;
/** Height of the cap's lower side above the skin: as it is, under a hovering finger, touched, and under the hardest press. */
const LIFT_MM = { plain: 3, hovered: 4, touched: 2, sunk: 0.2 };
/** Colours in sRGB. */
const COLOURS = { plain: 0x2c4a64, hovered: 0x3f7ba6, soft: 0x53c2f5, hard: 0x05307c, well: 0x06121d };
/** How fast a cap follows, per second. */
const FOLLOW_HZ = 28;
const FLASH_S = 0.42;
const FLASHES: Readonly<Record<string, number>> = { key: 0x5ac8fa, plus: 0x4ade9c, cancelled: 0xff6b6b, full: 0xff6b6b };

export class KeyMesh extends Group {
  readonly key: string;
  readonly #cap: Group;
  readonly #face: Mesh<ExtrudeGeometry, MeshStandardMaterial>;
  readonly #well: Mesh<ExtrudeGeometry, MeshBasicMaterial>;
  readonly #ring: Mesh<ExtrudeGeometry, MeshBasicMaterial>;
  readonly #label: Painted;
  readonly #colour = new Color();
  #flashS = FLASH_S;

  constructor(key: string, sizeMm: number) {
    super();
    this.key = key;
    const bevel = { bevelEnabled: true, bevelThickness: 0.5, bevelSize: 0.5, bevelOffset: -0.5, bevelSegments: 3, curveSegments: 8 };
    this.#face = new Mesh(
      new ExtrudeGeometry(roundedSquare(sizeMm, CORNER_MM), { depth: CAP_MM - 1, ...bevel }),
      new MeshStandardMaterial({ color: COLOURS.plain, roughness: 0.42, metalness: 0.1 }),
    );
    const flat = (grown: number): ExtrudeGeometry =>
      new ExtrudeGeometry(roundedSquare(sizeMm + grown, CORNER_MM + grown / 2), { depth: 0.1, bevelEnabled: false, curveSegments: 8 });
    this.#well = new Mesh(flat(1.2), new MeshBasicMaterial({ color: COLOURS.well, transparent: true, opacity: 0.82 }));
    this.#ring = new Mesh(flat(2), new MeshBasicMaterial({ transparent: true, depthWrite: false }));
    this.#ring.visible = false;
    this.#label = new Painted(sizeMm, sizeMm).paint((context) => paintLabel(context, key));
    this.#label.position.z = CAP_MM + 0.12;
    this.#cap = new Group().add(this.#face, this.#label);
    this.#cap.position.z = LIFT_MM.plain;
    this.#ring.position.z = 0.3;
    this.add(this.#well, this.#ring, this.#cap);
  }

  /** How far the cap stands above the skin, in millimetres. */
  get heightMm(): number {
    return this.#cap.position.z;
  }

  /** Go on by `seconds` towards the look of the view. */
  update({ isHovered, isPressed, forceN }: ViewLook, seconds: number): void {
    const share = Math.min(forceN / FULL_FORCE_N, 1);
    const pressed = LIFT_MM.touched + (LIFT_MM.sunk - LIFT_MM.touched) * share;
    const target = isPressed ? pressed : isHovered ? LIFT_MM.hovered : LIFT_MM.plain;
    const step = 1 - Math.exp(-FOLLOW_HZ * seconds);
    this.#cap.position.z += (target - this.#cap.position.z) * step;
    if (isPressed) this.#colour.set(COLOURS.soft).lerp(new Color(COLOURS.hard), share);
    else this.#colour.set(isHovered ? COLOURS.hovered : COLOURS.plain);
    this.#face.material.color.lerp(this.#colour, step);
    this.#face.material.emissive.copy(this.#face.material.color).multiplyScalar(isPressed ? 0.3 : isHovered ? 0.25 : 0.08);
    this.#fade(seconds);
  }

  /** A ring that spreads from the key: something was dialled, or was not. */
  flash(kind: string): void {
    this.#ring.material.color.set(FLASHES[kind] ?? COLOURS.soft);
    this.#flashS = 0;
  }

  dispose(): void {
    for (const mesh of [this.#face, this.#well, this.#ring]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.#label.dispose();
  }

  #fade(seconds: number): void {
    this.#flashS = Math.min(this.#flashS + seconds, FLASH_S);
    const share = this.#flashS / FLASH_S;
    this.#ring.visible = share < 1;
    this.#ring.scale.setScalar(1 + 0.5 * share);
    this.#ring.material.opacity = 0.9 * (1 - share);
  }
}

function paintLabel(context: CanvasRenderingContext2D, key: string): void {
  const letters = LETTERS[key];
  context.fillStyle = "#f4faff";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.font = "500 6.6px system-ui, sans-serif";
  context.fillText(key === "*" ? "∗" : key, 0, letters ? -1.1 : 0.3);
  if (!letters) return;
  context.fillStyle = "#c3dcf0";
  context.font = "600 2.4px system-ui, sans-serif";
  context.fillText(letters, 0, 4);
}
