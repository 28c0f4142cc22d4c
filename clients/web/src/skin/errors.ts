import { EgoTouchError } from "../errors.js";

/** A layout that no limb can carry; the message says which view and which key are wrong. */
export class LayoutError extends EgoTouchError {
  constructor(message: string) {
    super("config", message);
    this.name = "LayoutError";
  }
}
