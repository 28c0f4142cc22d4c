// The server's clock as seen from this page, from NTP's four timestamps. No message arrives before it was sent, so each probe bounds
// the offset from both sides; the narrowest bounds of all recent probes hold. Delays of the two ways need not come together.

/** At four probes a second these are 16 s, in which two ordinary clocks drift apart by under 1 ms (50 ppm). */
const KEPT = 64;

export class ClockOffset {
  #probes = []; // {least, most}: bounds of server minus client, in milliseconds
  #least = null;
  #most = null;

  /** Bound of the offset's error in milliseconds; null before the first reply. */
  get uncertaintyMs() {
    return this.#least === null ? null : (this.#most - this.#least) / 2;
  }

  /** Take one reply, received at `nowMs` of this page's clock. */
  add({ client_send_ms, server_receive_ms, server_send_ms }, nowMs) {
    const probe = { least: server_send_ms - nowMs, most: server_receive_ms - client_send_ms };
    if (!(probe.least <= probe.most)) return;
    this.#probes.push(probe);
    if (this.#probes.length > KEPT) this.#probes.shift();
    this.#least = Math.max(...this.#probes.map(({ least }) => least));
    this.#most = Math.min(...this.#probes.map(({ most }) => most));
    if (this.#least > this.#most) this.#restart(probe); // the clocks have drifted or jumped: older bounds hold no more
  }

  /** This page's time on the server's clock; null before the first reply. */
  toServerMs(nowMs) {
    return this.#least === null ? null : nowMs + (this.#least + this.#most) / 2;
  }

  /** Forget everything: another run of the server has another clock. */
  reset() {
    this.#probes = [];
    this.#least = this.#most = null;
  }

  #restart(probe) {
    this.#probes = [probe];
    this.#least = probe.least;
    this.#most = probe.most;
  }
}
