import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import type { TouchEvent } from "../../src/events.js";
import { layoutFromData, SkinViewGroup, type CallName } from "../../src/skin/index.js";
import { touchEvent } from "../support/events.js";

interface Vectors {
  layout: unknown;
  views: { name: string; points_mm: number[][] }[];
  programs: (Partial<TouchEvent> & { calls: string[] })[][];
}

const vectors = JSON.parse(readFileSync(new URL("vectors.json", import.meta.url), "utf8")) as Vectors;
const CALLS: readonly CallName[] = [
  "onHoverEnter", "onHoverMove", "onHoverExit", "onTouchDown", "onTouchMove", "onTouchUp", "onTouchCancel",
  "onDragStart", "onDrag", "onDragEnd", "onForce", "onClick", "onLongClick",
];

describe("skin views do what those of the Python package do", () => {
  const layout = layoutFromData(vectors.layout);

  test("keys lie where they lie there", () => {
    expect(layout.views.map(({ name }) => name)).toEqual(vectors.views.map(({ name }) => name));
    layout.views.forEach(({ region }, i) => {
      vectors.views[i]!.points_mm.flat().forEach((value, k) => expect(region.pointsMm.flat()[k]).toBeCloseTo(value, 9));
    });
  });

  test.each(vectors.programs.map((program, i) => [i, program] as const))("program %i leads to the same calls", (_, program) => {
    const group = new SkinViewGroup(layout);
    let heard: string[] = [];
    for (const view of layout.views) {
      for (const call of CALLS) {
        group.on(view.name, call, () => {
          heard.push(`${view.name} ${call}`);
          return call === "onLongClick" && view.label === "0";
        });
      }
    }
    for (const { calls, ...fields } of program) {
      heard = [];
      group.handle(touchEvent(fields));
      expect(heard).toEqual(calls);
    }
  });
});
