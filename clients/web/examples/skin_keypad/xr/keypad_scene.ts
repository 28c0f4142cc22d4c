/** The keypad on the wearer's skin as a scene of three.js. */
import { facing } from "../../../src/webxr/index.js";
import { SkinSurface } from "../../../src/three/index.js";
import { toView, type FingerLook, type SkinKeypad } from "../../../src/skin/index.js";
import type { KeypadModel } from "../keypad_model.js";
import { NOTES, STATES, STATE_COLOURS, type ShownState } from "../words.js";
import { HandShape } from "./hand_shape.js";
import { KeyMesh } from "./key.js";
import { Painted } from "./painting.js";
import { AmbientLight, Color, DirectionalLight, Group, Mesh, MeshBasicMaterial, RingGeometry, Scene } from "./three_parts.js";

/** Keys are hidden when the skin is seen flatter than this (cosine; about 84 degrees) or from behind. */
const LEAST_FACING = 0.1;
const DISPLAY_MM = { width: 80, height: 24, gap: 7, lift: 10 };
const FULL_FORCE_N = 3.5;
const NOTE_COLOURS: Readonly<Record<string, string>> = {
  key: "#5ac8fa", plus: "#4ade9c", erased: "#f0b429", cancelled: "#ff6b6b", full: "#ff6b6b",
};

/** One frame of a session: poses in the reference space. */
export interface XRMoment {
  readonly frame: XRFrame;
  readonly space: XRReferenceSpace;
  readonly sources: Iterable<XRInputSource>;
  readonly seconds: number;
}

export class KeypadScene extends Scene {
  readonly #model: KeypadModel;
  readonly #state: () => ShownState;
  readonly #hands: Readonly<Partial<Record<XRHandedness, HandShape>>>;
  #keypad: SkinKeypad | null = null;
  #skin = new SkinSurface({ host: "left", surface: "palm" });
  #keys: readonly KeyMesh[] = [];
  #display: Painted | null = null;
  #marks = new Map<number, FingerMark>();
  #shown = "";
  #serial: number;

  /** `showsHands` draws the wearer's hands, where the headset does not show the real ones. */
  constructor(model: KeypadModel, state: () => ShownState, showsHands: boolean) {
    super();
    this.#model = model;
    this.#state = state;
    this.#serial = model.note.serial;
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(0.4, 2, 1.2);
    this.add(new AmbientLight(0xffffff, 1.1), sun);
    this.#hands = showsHands ? { left: new HandShape(), right: new HandShape() } : {};
    if (showsHands) {
      this.background = new Color(0x101b26);
      this.add(...Object.values(this.#hands));
    }
  }

  /** The skin that carries the keys; its limb is null while the hand is not tracked. */
  get skin(): SkinSurface {
    return this.#skin;
  }

  get keys(): readonly KeyMesh[] {
    return this.#keys;
  }

  /** True while the keys can be seen. */
  get isShown(): boolean {
    return this.#skin.visible;
  }

  /** Follow the hands and the model. */
  update({ frame, space, sources, seconds }: XRMoment): void {
    if (this.#model.keypad !== this.#keypad) this.#lay(this.#model.keypad);
    for (const source of sources) this.#hands[source.handedness]?.track(frame, space, source.hand);
    this.#skin.track(frame, space, sources);
    const eye = frame.getViewerPose(space)?.transform.position;
    const { limb } = this.#skin;
    if (limb && eye) this.#skin.visible = facing(limb, this.#skin.surface, [eye.x, eye.y, eye.z]) > LEAST_FACING;
    for (const mesh of this.#keys) {
      const key = this.#keypad?.keys.find(({ key: name }) => name === mesh.key);
      if (key) mesh.update(this.#model.look(key), seconds);
    }
    this.#flash();
    this.#write();
    this.#mark(this.#model.fingers);
  }

  dispose(): void {
    this.#clear();
    for (const hand of Object.values(this.#hands)) hand.dispose();
  }

  #lay(keypad: SkinKeypad): void {
    this.#clear();
    this.#keypad = keypad;
    this.#skin = new SkinSurface({ host: keypad.host, surface: keypad.surface, reading: keypad.reading });
    this.#keys = keypad.keys.map((key) => {
      const mesh = new KeyMesh(key.key, keypad.pitchMm - keypad.gapMm);
      const [x, y] = key.centreMm;
      this.#skin.localPlace({ xMm: x, yMm: y }, 0, mesh.position);
      return mesh;
    });
    this.#display = new Painted(DISPLAY_MM.width, DISPLAY_MM.height);
    const [right, up] = toView(keypad.axes, [keypad.xMm, keypad.yMm]);
    const above = (keypad.rows.length * keypad.pitchMm) / 2 + DISPLAY_MM.gap + DISPLAY_MM.height / 2;
    this.#display.position.set(right, up + above, DISPLAY_MM.lift);
    this.#skin.add(...this.#keys, this.#display);
    this.add(this.#skin);
    this.#shown = "";
  }

  #clear(): void {
    for (const key of this.#keys) key.dispose();
    for (const mark of this.#marks.values()) mark.dispose();
    this.#marks.clear();
    this.#display?.dispose();
    this.#skin.removeFromParent();
  }

  #flash(): void {
    const { note } = this.#model;
    if (note.serial === this.#serial) return;
    this.#serial = note.serial;
    const name = note.kind === "plus" ? "0" : note.key;
    if (note.kind !== "erased") this.#keys.find(({ key }) => key === name)?.flash(note.kind);
  }

  #write(): void {
    const { number, note } = this.#model;
    const state = this.#state();
    const text = `${number}|${note.serial}|${state}`;
    if (text === this.#shown) return;
    this.#shown = text;
    const { width, height } = DISPLAY_MM;
    this.#display?.paint((context) => {
      context.fillStyle = "rgb(10 17 25 / .9)";
      context.strokeStyle = "rgb(120 160 195 / .55)";
      context.lineWidth = 0.4;
      context.beginPath();
      context.roundRect(-width / 2 + 0.4, -height / 2 + 0.4, width - 0.8, height - 0.8, 5);
      context.fill();
      context.stroke();
      context.textBaseline = "middle";
      context.textAlign = "left";
      context.fillStyle = "#eef6fc";
      context.font = `400 ${number.length > 12 ? 5.6 : 8.6}px system-ui, sans-serif`;
      context.fillText(number, -width / 2 + 5, -3.2, width - 10);
      context.font = "500 3.4px system-ui, sans-serif";
      context.fillStyle = (note.serial > 0 && NOTE_COLOURS[note.kind]) || "#a3b3c5";
      context.fillText(NOTES[note.kind](note), -width / 2 + 5, 7, width - 32);
      context.textAlign = "right";
      context.fillStyle = STATE_COLOURS[state];
      context.fillText(`● ${STATES[state]}`, width / 2 - 5, 7);
    });
  }

  #mark(fingers: readonly FingerLook[]): void {
    for (const [id, mark] of this.#marks) {
      if (fingers.some(({ pointerId }) => pointerId === id)) continue;
      mark.dispose();
      this.#marks.delete(id);
    }
    for (const finger of fingers) {
      const mark = this.#marks.get(finger.pointerId) ?? new FingerMark();
      this.#marks.set(finger.pointerId, mark);
      this.#skin.add(mark);
      this.#skin.localPlace(finger, 6, mark.position);
      mark.show(finger);
    }
  }
}

/** A ring where a fingertip is, which grows with its force. */
class FingerMark extends Group {
  readonly #ring = new Mesh(new RingGeometry(0.88, 1, 48), new MeshBasicMaterial({ color: 0xffdcbd, transparent: true, depthWrite: false }));

  constructor() {
    super();
    this.add(this.#ring);
  }

  show({ isTouching, forceN }: FingerLook): void {
    this.#ring.scale.setScalar(isTouching ? 6.2 + 2.6 * Math.min(forceN / FULL_FORCE_N, 1) : 5.6);
    this.#ring.material.opacity = isTouching ? 1 : 0.6;
  }

  dispose(): void {
    this.removeFromParent();
    this.#ring.geometry.dispose();
    this.#ring.material.dispose();
  }
}
