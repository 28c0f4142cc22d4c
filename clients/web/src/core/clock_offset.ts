// The server's clock as seen from here. No message arrives before it was sent, so each probe bounds the offset from both sides; the
// narrowest bounds of all recent probes hold. Delays of the two ways need not be alike.

/** At one probe a second, these are about a minute, in which two ordinary clocks drift apart by 3 ms at most (50 ppm). */
const KEPT = 64;

/** Times of one probe, in milliseconds of the clock that took them. */
export interface Probe {
  readonly clientSendMs: number;
  readonly serverReceiveMs: number;
  readonly serverSendMs: number;
  readonly clientReceiveMs: number;
}

interface Bounds {
  /** Server minus client, in milliseconds. */
  readonly leastMs: number;
  readonly mostMs: number;
}

export class ClockOffset {
  #probes: Bounds[] = [];
  #bounds: Bounds | null = null;

  /** The greatest error of the offset, in milliseconds; null before the first probe. */
  get uncertaintyMs(): number | null {
    return this.#bounds && (this.#bounds.mostMs - this.#bounds.leastMs) / 2;
  }

  /** Server minus client, in milliseconds; null before the first probe. */
  get offsetMs(): number | null {
    return this.#bounds && (this.#bounds.leastMs + this.#bounds.mostMs) / 2;
  }

  /** Take one probe; one that contradicts itself is passed over. */
  add({ clientSendMs, serverReceiveMs, serverSendMs, clientReceiveMs }: Probe): void {
    const probe = { leastMs: serverSendMs - clientReceiveMs, mostMs: serverReceiveMs - clientSendMs };
    if (!(probe.leastMs <= probe.mostMs)) return;
    this.#probes.push(probe);
    if (this.#probes.length > KEPT) this.#probes.shift();
    const leastMs = Math.max(...this.#probes.map((kept) => kept.leastMs));
    const mostMs = Math.min(...this.#probes.map((kept) => kept.mostMs));
    this.#bounds = { leastMs, mostMs };
    if (leastMs <= mostMs) return;
    this.#probes = [probe]; // a clock has drifted or jumped: older bounds hold no more
    this.#bounds = probe;
  }

  /** A time of this client on the server's clock; null before the first probe. */
  toServerMs(clientMs: number): number | null {
    return this.offsetMs === null ? null : clientMs + this.offsetMs;
  }

  /** Forget everything: another run of the server has another clock. */
  reset(): void {
    this.#probes = [];
    this.#bounds = null;
  }
}

export const millisecondsOf = (nanoseconds: bigint): number => Number(nanoseconds) / 1e6;
export const nanosecondsOf = (milliseconds: number): bigint => BigInt(Math.round(milliseconds * 1e6));
