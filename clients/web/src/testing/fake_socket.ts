// A WebSocket without a network.

/** The side of the server: what a client opens, sends and closes. */
export interface FakePeer {
  opened(socket: FakeSocket): void;
  received(socket: FakeSocket, data: Uint8Array): void;
  closed(socket: FakeSocket): void;
}

type Handler = ((event: never) => void) | null;

export class FakeSocket {
  readonly url: string;
  readonly protocol: string;
  readonly bufferedAmount = 0;
  binaryType = "blob";
  readyState: 0 | 1 | 3 = 0;
  onopen: Handler = null;
  onmessage: Handler = null;
  onclose: Handler = null;
  onerror: Handler = null;
  readonly #peer: FakePeer;

  constructor(peer: FakePeer, url: string | URL, protocols: string | string[] = []) {
    this.#peer = peer;
    this.url = String(url);
    this.protocol = [protocols].flat()[0] ?? "";
    peer.opened(this);
  }

  send(data: Uint8Array): void {
    if (this.readyState !== 1) throw new Error("this socket is not open");
    this.#peer.received(this, data);
  }

  close(): void {
    if (this.readyState === 3) return;
    this.readyState = 3;
    this.#peer.closed(this);
  }

  /** From the server: the connection is made. */
  accept(): void {
    this.readyState = 1;
    this.onopen?.({} as never);
  }

  /** From the server: a message comes. */
  deliver(data: Uint8Array): void {
    if (this.readyState === 1) this.onmessage?.({ data: data.slice().buffer } as never);
  }

  /** From the server: the connection ends, or is refused. */
  end(code: number, reason: string): void {
    if (this.readyState === 3) return;
    this.readyState = 3;
    this.onclose?.({ code, reason } as never);
  }
}
