// The server's clock as seen from this page: NTP's four timestamps, the probe with the shortest round trip counts.

const KEPT = 16;

export class ClockOffset {
  #probes = [];
  #best = null;

  /** Half the round trip of the best probe in milliseconds, the bound of the error; null before the first reply. */
  get uncertaintyMs() {
    return this.#best ? this.#best.roundTripMs / 2 : null;
  }

  /** Take one reply, received at `nowMs` of this page's clock. */
  add({ client_send_ms, server_receive_ms, server_send_ms }, nowMs) {
    const roundTripMs = nowMs - client_send_ms - (server_send_ms - server_receive_ms);
    if (!(roundTripMs >= 0)) return;
    this.#probes.push({ roundTripMs, offsetMs: (server_receive_ms - client_send_ms + server_send_ms - nowMs) / 2 });
    if (this.#probes.length > KEPT) this.#probes.shift();
    this.#best = this.#probes.reduce((best, probe) => (probe.roundTripMs < best.roundTripMs ? probe : best));
  }

  /** This page's time on the server's clock; null before the first reply. */
  toServerMs(nowMs) {
    return this.#best ? nowMs + this.#best.offsetMs : null;
  }

  /** Forget everything: another run of the server has another clock. */
  reset() {
    this.#probes = [];
    this.#best = null;
  }
}
