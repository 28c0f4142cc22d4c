// Skin touches as DOM PointerEvents in a real Chromium. The page is 200 x 200 px; a millimetre of skin is a pixel.

import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from "vitest";
import type { Browser, Page } from "playwright-core";
import { bundled, chromiumPath, launch, opened } from "../support/browser.js";
import type { Kit } from "./pointer_events.page.js";

declare const kit: Kit;

const BODY = `
  <div id="root" style="position: relative; width: 200px; height: 200px">
    <button id="left" style="position: absolute; left: 0; top: 0; width: 100px; height: 100px">
      <span id="inner" style="position: absolute; left: 50px; top: 0; width: 50px; height: 100px"></span></button>
    <button id="right" style="position: absolute; left: 100px; top: 0; width: 100px; height: 100px"></button>
    <label id="label" style="position: absolute; left: 0; top: 100px; width: 100px; height: 50px"><input id="box" type="checkbox">Box</label>
    <a id="link" href="#there" style="position: absolute; left: 100px; top: 100px; width: 100px; height: 50px">Link</a>
  </div>`;
/** Places on the skin: in the middle of each element. */
const LEFT = [25, 150] as const;
const INNER = [75, 150] as const;
const RIGHT = [150, 150] as const;
const LABEL = [80, 75] as const;
const LINK = [150, 75] as const;

describe.skipIf(chromiumPath() === null)("pointer events", { retry: 1 }, () => {
  let browser: Browser;
  let script: string;
  let page: Page;
  let close: () => Promise<void>;

  beforeAll(async () => {
    [browser, script] = await Promise.all([launch(), bundled("pointer_events.page.ts")]);
  });
  afterAll(() => browser.close());
  beforeEach(async () => {
    ({ page, close } = await opened(browser, BODY, script));
    await page.waitForFunction(() => "kit" in globalThis);
  });
  afterEach(() => close());

  const take = () => page.evaluate(() => kit.take());

  test("a tap is what a touch screen's would be, and nothing else happens", async () => {
    await page.evaluate((at) => kit.finger.tap(...at, 1.75).leave(), LEFT);
    expect(await take()).toEqual([
      "pointerover left", "pointerenter root", "pointerenter left", "pointermove left",
      "pointerdown left", "gotpointercapture left", "pointermove left", "pointerup left", "lostpointercapture left", "click left",
      "pointerout left", "pointerleave left", "pointerleave root",
    ]);
    const [down] = await page.evaluate(() => kit.fields("pointerdown"));
    expect(down).toMatchObject({
      pointerId: 0x45540001, pointerType: "touch", isPrimary: true, pressure: 0.5, buttons: 1, button: 0, clientX: 25, clientY: 50, bubbles: true, cancelable: true,
      isTrusted: false,
    });
    expect(await page.evaluate(() => kit.fields("pointerup"))).toMatchObject([{ pressure: 0, buttons: 0, button: 0 }]);
    expect(await page.evaluate(() => kit.fields("click"))).toMatchObject([{ detail: 1, pointerId: 0x45540001, pointerType: "touch" }]);
    expect(await page.evaluate(() => kit.fields("pointerenter").map(({ bubbles }) => bubbles))).toEqual([false, false]);
  });

  test("a hovering finger crosses elements without a button", async () => {
    await page.evaluate(([a, b, c]) => void kit.finger.hover(...a).hover(...b).hover(...c), [LEFT, INNER, RIGHT] as const);
    expect((await take()).slice(4)).toEqual([
      "pointerout left", "pointerover inner", "pointerenter inner", "pointermove inner",
      "pointerout inner", "pointerleave inner", "pointerleave left", "pointerover right", "pointerenter right", "pointermove right",
    ]);
    const moves = await page.evaluate(() => kit.fields("pointermove"));
    expect(moves.map(({ buttons, button, pressure }) => [buttons, button, pressure])).toEqual([[0, -1, 0], [0, -1, 0], [0, -1, 0]]);
  });

  test("a drag stays with the element that it began on, and does not click", async () => {
    await page.evaluate(([from, to]) => void kit.finger.drag(from, to, { frames: 2 }), [LEFT, RIGHT] as const);
    await page.evaluate((at) => void kit.finger.hover(...at), RIGHT);
    expect((await take()).slice(4)).toEqual([
      "pointerdown left", "gotpointercapture left", "pointermove left", "pointermove left", "pointerup left", "lostpointercapture left",
      "pointerout left", "pointerleave left", "pointerover right", "pointerenter right", "pointermove right",
    ]);
  });

  test("capture can be taken by another element and given back", async () => {
    const states = await page.evaluate(([from, to]) => {
      const [left, right] = ["left", "right"].map((id) => document.getElementById(id)!) as [HTMLElement, HTMLElement];
      const { finger } = kit;
      const id = 0x45540001;
      const states: unknown[] = [];
      left.addEventListener("pointerdown", () => {
        states.push(left.hasPointerCapture(id));
        right.setPointerCapture(id);
        states.push(left.hasPointerCapture(id), right.hasPointerCapture(id));
      }, { once: true });
      finger.hover(...from).down().move();
      right.releasePointerCapture(id);
      states.push(right.hasPointerCapture(id));
      finger.move(...to).move(...from).up();
      return states;
    }, [LEFT, INNER] as const);
    expect(states).toEqual([true, false, true, false]);
    expect((await take()).slice(4)).toEqual([
      "pointerdown left", "gotpointercapture right", "pointerout left", "pointerleave left", "pointerover right", "pointerenter right", "pointermove right",
      "lostpointercapture right", "pointerout right", "pointerleave right", "pointerover inner", "pointerenter left", "pointerenter inner", "pointermove inner",
      "pointerout inner", "pointerleave inner", "pointerover left", "pointermove left", "pointerup left",
    ]);
  });

  test("capture of ids that are not ours is still the browser's affair, of elements outside the document an error", async () => {
    const names = await page.evaluate((at) => {
      const caught = (work: () => void) => {
        try {
          work();
          return "nothing";
        } catch (error) {
          return (error as Error).name;
        }
      };
      kit.finger.hover(...at).down();
      const element = document.createElement("div");
      const ours = caught(() => element.setPointerCapture(0x45540001));
      const theirs = caught(() => document.body.setPointerCapture(777));
      kit.detach();
      return [ours, theirs, caught(() => document.body.setPointerCapture(0x45540001)), document.body.hasPointerCapture(1)];
    }, LEFT);
    expect(names).toEqual(["InvalidStateError", "NotFoundError", "NotFoundError", false]);
  });

  test("a lost finger is a pointercancel with the fields of its last event, and no click", async () => {
    await page.evaluate((at) => kit.finger.hover(...at).down(2).move().lose(), LEFT);
    expect((await take()).slice(4)).toEqual([
      "pointerdown left", "gotpointercapture left", "pointermove left", "pointercancel left", "lostpointercapture left",
      "pointerout left", "pointerleave left", "pointerleave root",
    ]);
    const [cancelled] = await page.evaluate(() => kit.fields("pointercancel"));
    expect(cancelled).toMatchObject({ clientX: 25, clientY: 50, cancelable: false, pointerId: 0x45540001 });
  });

  test("a long press opens a context menu; preventing it keeps the click away", async () => {
    await page.evaluate((at) => void kit.finger.press(...at), RIGHT);
    expect((await take()).filter((line) => !line.startsWith("pointer") && !line.includes("capture"))).toEqual(["contextmenu right", "click right"]);
    await page.evaluate((at) => {
      document.addEventListener("contextmenu", (event) => event.preventDefault());
      kit.finger.press(...at);
    }, RIGHT);
    expect((await take()).filter((line) => !line.startsWith("pointer") && !line.includes("capture"))).toEqual(["contextmenu right"]);
  });

  test("a listener of the client that consumes the long click keeps the DOM click away too", async () => {
    await page.evaluate((at) => {
      kit.client.onLongClick(() => true);
      kit.finger.press(...at);
    }, RIGHT);
    expect(await take()).not.toContain("click right");
  });

  test("checkboxes, links and the focus behave as under any finger", async () => {
    const state = await page.evaluate(([label, link]) => {
      kit.finger.tap(...label);
      const { checked } = document.getElementById("box") as HTMLInputElement;
      kit.finger.tap(...link);
      return [checked, location.hash, document.activeElement?.id];
    }, [LABEL, LINK] as const);
    expect(state).toEqual([true, "#there", "link"]);
  });

  test("coalesced events are those that were merged, and the event itself; nothing is predicted", async () => {
    const places = await page.evaluate((at) => {
      kit.finger.hover(...at).down();
      const event = kit.client.pointers[0]!;
      const wire = { type: 5, pointerId: 1, contactId: 1, downTimeNs: event.downTimeNs!, hand: 2, finger: 2, surface: 1, pitchRad: 1, yMm: 150 };
      const timestampNs = event.timestampNs + 1000n;
      const coalesced = [26, 27].map((xMm) => ({ ...wire, xMm, timestampNs }));
      kit.server.publish([{ ...wire, xMm: 28, timestampNs, coalesced }], timestampNs);
      const last = kit.last();
      return [last.type, last.getCoalescedEvents().map(({ clientX, target }) => [clientX, (target as Element | null)?.id]), last.getPredictedEvents().length];
    }, LEFT);
    expect(places).toEqual(["pointermove", [[26, "left"], [27, "left"], [28, "left"]], 0]);
  });

  test("angles say where the finger's body lies on the screen", async () => {
    const angles = await page.evaluate((at) => {
      for (const [i, yawRad] of [0, Math.PI / 2, Math.PI, -Math.PI / 2].entries()) kit.server.finger({ finger: "ring", hand: i % 2 ? "left" : "right", pitchRad: 0.3, yawRad }).tap(...at).leave();
      return kit.fields("pointerdown").map(({ altitudeAngle, azimuthAngle }) => [altitudeAngle, azimuthAngle]);
    }, LEFT);
    // A finger that points up the screen (yaw 0, +y) has its body below its tip: a quarter turn clockwise from the right.
    const turns = [1, 2, 3, 0].map((quarters) => (quarters * Math.PI) / 2);
    expect(angles).toHaveLength(4);
    angles.forEach(([altitude, azimuth], i) => {
      expect(altitude).toBeCloseTo(0.3, 5);
      expect(Math.cos(Number(azimuth) - turns[i]!)).toBeCloseTo(1, 5);
    });
  });

  test("two fingers are two pointers, the first of them primary", async () => {
    await page.evaluate(([a, b]) => {
      const second = kit.server.finger({ finger: "middle" });
      kit.finger.hover(...a).down();
      second.hover(...b).down();
      kit.finger.up();
      second.up();
    }, [LEFT, RIGHT] as const);
    const downs = await page.evaluate(() => kit.fields("pointerdown").map(({ pointerId, isPrimary }) => [pointerId, isPrimary]));
    expect(downs).toEqual([[0x45540001, true], [0x45540002, false]]);
    expect((await take()).filter((line) => line.startsWith("click"))).toEqual(["click left", "click right"]);
  });

  test("a filter keeps other fingers out, and follows a touch that leaves its surface to the end", async () => {
    await page.evaluate(([a, b]) => {
      kit.detach();
      kit.take();
      kit.attach({ surface: "palm", finger: "index" });
      kit.server.finger({ finger: "ring" }).tap(...a).leave();
      kit.finger.hover(...a).down();
      const { downTimeNs, timestampNs } = kit.client.pointers.find(({ type }) => type === "down")!;
      const wire = { pointerId: 1, contactId: 1, hand: 2, finger: 2, surface: 3, xMm: b[0], yMm: b[1], timestampNs: timestampNs + 1n };
      kit.server.publish([{ ...wire, type: 6, downTimeNs: downTimeNs! }], timestampNs + 1n);
      kit.server.publish([{ ...wire, type: 2 }], timestampNs + 1n);
    }, [LEFT, LEFT] as const);
    expect(await take()).toEqual([
      "pointerover left", "pointerenter root", "pointerenter left", "pointermove left", "pointerdown left", "gotpointercapture left",
      "pointerup left", "lostpointercapture left", "pointerout left", "pointerleave left", "pointerleave root",
    ]);
  });

  test("removing the attachment cancels what is down", async () => {
    await page.evaluate((at) => {
      kit.finger.hover(...at).down();
      kit.take();
      kit.detach();
      kit.finger.move().up();
    }, LEFT);
    expect(await take()).toEqual(["gotpointercapture left", "pointercancel left", "lostpointercapture left", "pointerout left", "pointerleave left", "pointerleave root"]);
  });

  test("an element that is taken away in a touch ends nothing but its own events", async () => {
    await page.evaluate((at) => {
      kit.finger.hover(...at).down().move();
      kit.take();
      document.getElementById("left")!.remove();
      kit.finger.move().up();
    }, LEFT);
    expect(await take()).toEqual(["pointermove root", "pointerup root"]);
  });
});
