import { beforeEach, describe, expect, test } from "vitest";
import { LayoutError, layoutFromData, SkinViewGroup, toHostFrame, toView, readingAxes } from "../../src/skin/index.js";
import { touchEvent } from "../support/events.js";

const PHONE = {
  views: [
    { type: "keypad", name: "pad", surface: "palm", host: "left", rows: ["123", "456", "789", "*0#"], x_mm: -4, y_mm: 46, pitch_mm: 15 },
    { type: "button", name: "call", region: { surface: "inner_forearm", circle: { x_mm: 0, y_mm: -40, radius_mm: 12 } } },
  ],
};
/** Keys of the left palm as its wearer sees them: the thumb's side, +x, is on the left. */
const AT = { "1": { xMm: 11, yMm: 68.5 }, "5": { xMm: -4, yMm: 53.5 }, "0": { xMm: -4, yMm: 23.5 } } as const;

describe("a keypad on the palm", () => {
  let group: SkinViewGroup;
  let keys: string[];
  beforeEach(() => {
    group = new SkinViewGroup(layoutFromData(PHONE));
    keys = [];
    group.onKey(({ key }) => keys.push(key));
    group.handle(touchEvent({ type: "hover_enter", ...AT["5"] }));
  });
  const look = (key: string): object => group.look(group.layout.keypads[0]!.keys.find((k) => k.key === key)!);

  test("highlights the key under a hovering finger, sinks the pressed one by its force, and gives the key on lifting", () => {
    expect(look("5")).toEqual({ isHovered: true, isPressed: false, forceN: 0 });
    group.handle(touchEvent({ type: "down", forceN: 0.5, ...AT["5"] }));
    group.handle(touchEvent({ type: "move", forceN: 1.5, ...AT["5"] }));
    expect(look("5")).toEqual({ isHovered: false, isPressed: true, forceN: 1.5 });
    expect(group.fingers).toMatchObject([{ isTouching: true, host: "left", forceN: 1.5 }]);
    expect(keys).toEqual([]);
    group.handle(touchEvent({ type: "up", ...AT["5"] }));
    expect(keys).toEqual(["5"]);
    expect(look("5")).toEqual({ isHovered: false, isPressed: false, forceN: 0 });
    group.handle(touchEvent({ type: "hover_exit" }));
    expect(group.fingers).toEqual([]);
  });

  test("gives no key for a cancelled touch, whoever cancelled it", () => {
    group.handle(touchEvent({ type: "down", ...AT["1"] }));
    group.handle(touchEvent({ type: "cancel", reason: "disconnected", local: true, ...AT["1"] }));
    expect(look("1")).toEqual({ isHovered: false, isPressed: false, forceN: 0 });
    expect(keys).toEqual([]);
  });

  test("gives no key for what came too late", () => {
    group.handle(touchEvent({ type: "down", late: true, ...AT["1"] }));
    group.handle(touchEvent({ type: "up", ...AT["1"] }));
    group.handle(touchEvent({ type: "down", contactId: 2, ...AT["1"] }));
    group.handle(touchEvent({ type: "up", contactId: 2, late: true, ...AT["1"] }));
    expect(keys).toEqual([]);
  });

  test("lets go without a key when events are missing", () => {
    const heard: string[] = [];
    group.on("pad/1", "onTouchCancel", () => heard.push("cancel"));
    group.handle(touchEvent({ type: "down", ...AT["1"] }));
    group.handle(touchEvent({ type: "hover_enter", ...AT["5"] }));
    group.handle(touchEvent({ type: "up", ...AT["1"] }));
    expect(heard).toEqual(["cancel"]);
    expect(keys).toEqual([]);
  });

  test("calls every listener, even when one throws, and stops calling those that have ended", () => {
    const broken = (): never => {
      throw new Error("broken");
    };
    const end = group.on("pad/5", "onTouchDown", broken);
    let calls = 0;
    group.on("pad/5", "onTouchDown", () => (calls += 1));
    expect(() => group.handle(touchEvent({ type: "down", ...AT["5"] }))).toThrow("broken");
    end();
    group.handle(touchEvent({ type: "up", ...AT["5"] }));
    group.handle(touchEvent({ type: "down", ...AT["5"] }));
    expect(calls).toBe(2);
  });

  test("says which views there are when asked for another", () => {
    expect(() => group.on("pad/x", "onClick", () => 0)).toThrow(/there is no view pad\/x; there are: pad\/1/);
  });
});

test("the wearer's view and the host frame are each other's inverse", () => {
  for (const host of ["left", "right"] as const) {
    for (const surface of ["palm", "back_of_hand", "inner_forearm", "outer_forearm"] as const) {
      const axes = readingAxes(surface, host);
      expect(toHostFrame(axes, toView(axes, [7, -3]))).toEqual([7, -3]);
    }
  }
  expect(readingAxes("palm", "left")).toEqual({ right: [-1, 0], up: [0, 1] });
});

test.each([
  [{}, /the layout: views is missing/],
  [{ views: [] }, /no views/],
  [{ views: [{ type: "dial", name: "d" }] }, /view d has type "dial"/],
  [{ views: [{ ...PHONE.views[0], pitch_mm: 5 }] }, /pitch of at least 12 mm/],
  [{ views: [{ ...PHONE.views[0], y_mm: 10 }] }, /lies across the wrist/],
  [{ views: [{ ...PHONE.views[0], rows: ["12", "23"] }] }, /each key once/],
  [{ views: [{ ...PHONE.views[0], surface: "knee" }] }, /surface is "knee": give one of palm/],
  [{ views: [{ ...PHONE.views[0], color: 1 }] }, /there is no key color/],
  [{ views: [PHONE.views[1], PHONE.views[1]] }, /used twice/],
  [{ views: [{ type: "button", name: "b", region: { surface: "palm", points_mm: [[0, 0], [0, 1], [0, 2]] } }] }, /is empty/],
  [{ views: [{ type: "button", name: "b", region: { surface: "palm" } }] }, /0 shapes/],
  [7, /the layout is 7/],
])("a wrong layout is refused: %j", (data, message) => {
  expect(() => layoutFromData(data)).toThrow(LayoutError);
  expect(() => layoutFromData(data)).toThrow(message);
});
