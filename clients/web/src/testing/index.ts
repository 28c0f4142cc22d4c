export { FakeFinger, FRAME_MS, type FingerSettings, type WireEvent } from "./fake_finger.js";
export { FakeServer } from "./fake_server.js";
export { ManualClock } from "./manual_clock.js";
