// Sends what is played: at most 75 times a second, and ten times a second while nothing changes, as the server forgets a page
// that has gone quiet.

const LEAST_MS = 1000 / 75;
const AGAIN_MS = 100;

export class PointerSender {
  #connection;
  #sent = "";
  #at = 0;

  constructor(connection) {
    this.#connection = connection;
    connection.addEventListener("welcome", () => (this.#sent = ""));
  }

  /** Send `pointers` when they are new or the last message is old; `host` is the touched arm. True when they were sent. */
  offer(pointers, host, now) {
    if (now - this.#at < LEAST_MS) return false;
    const hand = `HANDEDNESS_${host === "LEFT" ? "RIGHT" : "LEFT"}`;
    const message = {
      simulated: {
        pointers: pointers.map((pointer) => ({
          ...pointer,
          hand,
          finger: `FINGER_${pointer.finger}`,
          surface: `SURFACE_${pointer.surface}`,
        })),
      },
    };
    const text = JSON.stringify(message);
    if (text === this.#sent && (!pointers.length || now - this.#at < AGAIN_MS)) return false;
    if (!this.#connection.send(message)) return false;
    this.#sent = text;
    this.#at = now;
    return true;
  }
}
