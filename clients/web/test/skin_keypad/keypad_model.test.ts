import { beforeEach, describe, expect, test } from "vitest";
import { KeypadModel } from "../../examples/skin_keypad/keypad_model.js";
import layoutData from "../../examples/skin_keypad/layout.json" with { type: "json" };
import type { TouchEvent } from "../../src/events.js";
import { layoutFromData, toHostFrame } from "../../src/skin/index.js";
import { touchEvent } from "../support/events.js";

describe("the dialled number", () => {
  let model: KeypadModel;
  let changes: number;
  beforeEach(() => {
    changes = 0;
    model = new KeypadModel(layoutFromData(layoutData), () => (changes += 1));
  });

  const send = (fields: Partial<TouchEvent>): void => model.handle({ events: [touchEvent(fields)] });
  const at = (key: string): Partial<TouchEvent> => {
    const { keypad } = model;
    const [xMm, yMm] = keypad.keys.find((candidate) => candidate.key === key)!.centreMm;
    return { xMm, yMm, surface: keypad.surface, hand: keypad.host === "left" ? "right" : "left" };
  };
  const tap = (...keys: string[]): void => {
    for (const key of keys) {
      send({ type: "hover_enter", ...at(key) });
      send({ type: "down", forceN: 1, ...at(key) });
      send({ type: "up", ...at(key) });
      send({ type: "hover_exit", ...at(key) });
    }
  };
  /** Drag by this way as the wearer sees it, and lift. */
  const drag = (key: string, right: number, up: number, ending: Partial<TouchEvent> = { type: "up" }): void => {
    const place = at(key);
    const [dxMm, dyMm] = toHostFrame(model.keypad.axes, [right, up]);
    const there = { ...place, xMm: place.xMm! + dxMm, yMm: place.yMm! + dyMm, dxMm, dyMm };
    send({ type: "hover_enter", ...place });
    send({ type: "down", forceN: 1, ...place });
    send({ type: "move", forceN: 1, ...there });
    send({ type: "drag_start", forceN: 1, ...there });
    send({ type: "drag_end", ...there, reason: ending.reason ?? null });
    send({ ...there, ...ending });
    send({ type: "hover_exit", ...there });
  };

  test("grows by the keys that are tapped, on every surface of either hand", () => {
    for (const surface of ["palm", "back_of_hand", "inner_forearm", "outer_forearm"] as const) {
      for (const host of ["left", "right"] as const) {
        model.clear();
        model.choose(surface, host);
        tap(..."1234567890*#");
        expect(model.number).toBe("1234567890*#");
      }
    }
    expect(changes).toBeGreaterThan(100);
  });

  test("gets a + for a held 0, and nothing more for holding other keys", () => {
    send({ type: "hover_enter", ...at("0") });
    send({ type: "down", ...at("0") });
    send({ type: "long_click", ...at("0") });
    send({ type: "up", ...at("0") });
    send({ type: "down", ...at("5") });
    send({ type: "long_click", ...at("5") });
    send({ type: "up", ...at("5") });
    expect(model.number).toBe("+5");
  });

  test("loses its last digit when a finger is dragged to the wearer's left, on palm and forearm", () => {
    for (const surface of ["palm", "inner_forearm"] as const) {
      for (const host of ["left", "right"] as const) {
        model.clear();
        model.choose(surface, host);
        tap("1", "2");
        drag("5", 30, 0);
        drag("5", 0, 30);
        drag("5", -30, 40);
        expect(model.number).toBe("12");
        drag("5", -30, 5);
        expect(model.number).toBe("1");
        expect(model.note).toMatchObject({ kind: "erased", key: "2" });
      }
    }
  });

  test("stays as it is when a drag is cancelled, when there is nothing to erase, and when it is full", () => {
    tap("7");
    drag("5", -30, 0, { type: "cancel", reason: "tracking_lost" });
    expect(model.number).toBe("7");
    expect(model.note).toMatchObject({ kind: "cancelled", key: "5", reason: "tracking_lost" });
    drag("5", -30, 0);
    drag("5", -30, 0);
    expect(model.number).toBe("");
    tap(..."1234567890".repeat(3));
    expect(model.number).toHaveLength(24);
    expect(model.note.kind).toBe("full");
  });

  test("is dialled on whichever hand is touched", () => {
    send({ type: "hover_enter", hand: "left", xMm: 0, yMm: 46 });
    expect(model.host).toBe("right");
    expect(model.fingers).toHaveLength(1);
    // A second finger, on the other hand, does not turn the picture round.
    send({ type: "hover_enter", pointerId: 2, hand: "right" });
    expect(model.host).toBe("right");
    expect(model.fingers).toHaveLength(1);
  });
});
