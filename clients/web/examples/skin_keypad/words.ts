/** What the page says. */
import type { EgoTouchClient } from "../../src/index.js";
import type { Note } from "./keypad_model.js";

export type ShownState = EgoTouchClient["state"];

/** What a telephone writes below its keys; + is what 0 gives when it is held. */
export const LETTERS: Readonly<Record<string, string>> = {
  "2": "ABC", "3": "DEF", "4": "GHI", "5": "JKL", "6": "MNO", "7": "PQRS", "8": "TUV", "9": "WXYZ", "0": "+",
};

export const STATE_COLOURS: Readonly<Record<ShownState, string>> = {
  connecting: "#f0b429",
  live: "#4ade9c",
  stale: "#f0b429",
  disconnected: "#ff6b6b",
};

export const STATES: Readonly<Record<ShownState, string>> = {
  connecting: "Connecting",
  live: "Live",
  stale: "Silent",
  disconnected: "Disconnected",
};

const REASONS: Readonly<Record<string, string>> = {
  tracking_lost: "the camera lost the hand",
  hand_swapped: "the hands were mixed up",
  source_stalled: "the camera stopped",
  source_ended: "the recording ended",
  disconnected: "the server fell silent",
  server_stopped: "the server stopped",
};

export const NOTES: Readonly<Record<Note["kind"], (note: Note) => string>> = {
  key: ({ key }) => (key ? `${key} dialled` : "Tap a key on the skin"),
  plus: () => "0 held: +",
  erased: ({ key }) => `${key} erased`,
  cancelled: ({ reason }) => `Nothing dialled: ${REASONS[reason ?? ""] ?? "the touch was cancelled"}`,
  full: () => "No room for more digits",
};
