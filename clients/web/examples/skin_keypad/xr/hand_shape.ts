/** The wearer's hands as plain shapes, for headsets that do not show the real ones. */
import { CapsuleGeometry, Group, InstancedMesh, Matrix4, Mesh, MeshStandardMaterial, Quaternion, SphereGeometry, Vector3 } from "./three_parts.js";

const FINGERS = ["thumb", "index-finger", "middle-finger", "ring-finger", "pinky-finger"] as const;
const PARTS = ["metacarpal", "phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip"] as const;
const JOINTS: readonly XRHandJoint[] = [
  "wrist",
  ...FINGERS.flatMap((finger) =>
    PARTS.filter((part) => finger !== "thumb" || part !== "phalanx-intermediate").map((part) => `${finger}-${part}` as XRHandJoint),
  ),
];
/** Bones as pairs of joints: along each finger, from the wrist to each, and across the knuckles. */
const BONES: readonly (readonly [number, number])[] = JOINTS.flatMap((joint, i): (readonly [number, number])[] => {
  if (i === 0) return [];
  if (joint.endsWith("metacarpal")) return [[0, i]];
  return joint.endsWith("proximal") && i > 7 ? [[i - 1, i], [i - 5, i]] : [[i - 1, i]];
});
/** A joint without a radius of its own, in metres. */
const RADIUS_M = 0.009;
/** Balls larger than this would stick out of the palm and hide keys. */
const MOST_RADIUS_M = 0.0135;
const UP = new Vector3(0, 1, 0);
const [WRIST, KNUCKLE] = [0, JOINTS.indexOf("middle-finger-phalanx-proximal")];
/** Beyond the wrist WebXR knows nothing of an arm; this much is drawn, in metres: as thick as carries the keys (`SKIN_MM`). */
const FOREARM_M = { radius: 0.024, length: 0.22 };

export class HandShape extends Group {
  readonly #material = new MeshStandardMaterial({ color: 0xb98a6d, roughness: 0.85 });
  readonly #joints = new InstancedMesh(new SphereGeometry(1, 16, 12), this.#material, JOINTS.length);
  readonly #bones = new InstancedMesh(new CapsuleGeometry(1, 1, 3, 12), this.#material, BONES.length);
  readonly #forearm = new Mesh(new CapsuleGeometry(FOREARM_M.radius, FOREARM_M.length, 8, 24), this.#material);
  readonly #places = JOINTS.map(() => new Vector3());
  readonly #radii = JOINTS.map(() => RADIUS_M);

  constructor() {
    super();
    this.add(this.#joints, this.#bones, this.#forearm);
    for (const mesh of [this.#joints, this.#bones]) mesh.frustumCulled = false;
  }

  /** Follow a hand; invisible while a joint is missing. */
  track(frame: XRFrame, space: XRSpace, hand: XRHand | null | undefined): void {
    this.visible = !!hand && JOINTS.every((joint, i) => this.#read(frame, space, hand.get(joint), i));
    if (!this.visible) return;
    const matrix = new Matrix4();
    this.#places.forEach((place, i) => {
      const radius = (this.#radii[i] ?? RADIUS_M) * 0.92;
      this.#joints.setMatrixAt(i, matrix.compose(place, new Quaternion(), new Vector3(radius, radius, radius)));
    });
    BONES.forEach(([from, to], i) => {
      const [a, b] = [this.#places[from]!, this.#places[to]!];
      const along = new Vector3().subVectors(b, a);
      const length = along.length();
      const radius = Math.min(this.#radii[from] ?? RADIUS_M, this.#radii[to] ?? RADIUS_M) * 0.92;
      const turn = new Quaternion().setFromUnitVectors(UP, along.normalize());
      // A capsule of radius 1 and length 1: its straight part becomes the bone.
      this.#bones.setMatrixAt(i, matrix.compose(new Vector3().addVectors(a, b).multiplyScalar(0.5), turn, new Vector3(radius, length / 2, radius)));
    });
    for (const mesh of [this.#joints, this.#bones]) mesh.instanceMatrix.needsUpdate = true;
    this.#layForearm(this.#places[WRIST]!, this.#places[KNUCKLE]!);
  }

  dispose(): void {
    this.#material.dispose();
    for (const mesh of [this.#joints, this.#bones, this.#forearm]) mesh.geometry.dispose();
  }

  /** From the wrist on, straight away from the fingers: where the events have it. */
  #layForearm(wrist: Vector3, knuckle: Vector3): void {
    const away = new Vector3().subVectors(wrist, knuckle).normalize();
    this.#forearm.quaternion.setFromUnitVectors(UP, away);
    this.#forearm.position.copy(wrist).addScaledVector(away, FOREARM_M.length / 2);
  }

  #read(frame: XRFrame, space: XRSpace, joint: XRJointSpace | undefined, i: number): boolean {
    const pose = joint && frame.getJointPose?.(joint, space);
    if (!pose) return false;
    const { x, y, z } = pose.transform.position;
    this.#places[i]?.set(x, y, z);
    this.#radii[i] = Math.min(pose.radius || RADIUS_M, MOST_RADIUS_M);
    return true;
  }
}
