// `egotouch simulate` as a process of its own, and a hand on it.

import { spawn, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import { existsSync } from "node:fs";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import type { EgoTouchClient, Finger, Handedness, Surface } from "../../src/index.js";
import { FINGERS, HANDS, SURFACES } from "../../src/wire/enums.js";

export const ROOT = fileURLToPath(new URL("../../../../", import.meta.url));
const VENV_PYTHON = `${ROOT}.venv/bin/python`;
export const PYTHON = process.env["EGOTOUCH_PYTHON"] ?? (existsSync(VENV_PYTHON) ? VENV_PYTHON : "python3");

/** Runs the command `egotouch`; on Linux it ends with the process that started it, however that ends. */
const EGOTOUCH = `
import runpy, sys
if sys.platform == "linux":
    import ctypes
    ctypes.CDLL(None).prctl(1, 9)  # PR_SET_PDEATHSIG, SIGKILL
runpy.run_module("egotouch_sdk.cli.main", run_name="__main__", alter_sys=True)
`;
const running = new Set<ChildProcess>();
process.on("exit", () => running.forEach((server) => server.kill("SIGKILL")));

/** Nothing here takes long; what takes longer has failed. */
export const PATIENCE_MS = 30_000;

export class PythonServer {
  readonly #command: readonly string[];
  #process: ChildProcess | null = null;
  #port = "0";

  /** Arguments of the command `egotouch`. */
  constructor(command: readonly string[] = ["simulate", "--no-browser"]) {
    this.#command = command;
  }

  get httpUrl(): string {
    return `http://127.0.0.1:${this.#port}/`;
  }

  get url(): string {
    return `ws://127.0.0.1:${this.#port}/`;
  }

  /** Start, and wait for the address that it prints; the port stays the same over restarts. */
  async start(): Promise<void> {
    // A loaded machine may hold the server up for longer than a camera may stall.
    const env = { ...process.env, EGOTOUCH_STATE__STALL_MS: "5000" };
    const started = spawn(PYTHON, ["-c", EGOTOUCH, ...this.#command, "--port", this.#port], { cwd: ROOT, env, stdio: ["ignore", "pipe", "inherit"] });
    this.#process = started;
    running.add(started);
    started.once("exit", () => running.delete(started));
    for await (const line of createInterface({ input: started.stdout })) {
      const address = /http:\/\/[^/]*:(\d+)\//.exec(line);
      if (!address) continue;
      this.#port = address[1]!;
      started.stdout.resume();
      return;
    }
    throw new Error("the server ended without saying where it listens");
  }

  /** End it without a word, as a crash would. */
  async kill(): Promise<void> {
    const server = this.#process;
    this.#process = null;
    if (!server || server.exitCode !== null || server.signalCode !== null) return;
    server.kill("SIGKILL");
    await once(server, "exit");
  }

  signal(name: "SIGSTOP" | "SIGCONT" | "SIGINT"): void {
    this.#process?.kill(name);
  }
}

/** Wait for a condition that events bring about. */
export async function until(condition: () => boolean, what: () => string = () => String(condition)): Promise<void> {
  const deadline = performance.now() + PATIENCE_MS;
  while (!condition()) {
    if (performance.now() > deadline) throw new Error(`waited in vain for: ${what()}`);
    await new Promise((resolve) => setTimeout(resolve, 10));
  }
}

export interface Played {
  readonly xMm?: number;
  readonly yMm?: number;
  readonly forceN?: number;
  readonly finger?: Finger;
  readonly hand?: Handedness;
  readonly surface?: Surface;
}

/** What is played goes out again and again, as the server forgets a page that falls silent. */
const AGAIN_MS = 40;

/** Fingers played through `SimulatedPointers`; each is where it was put until it is put elsewhere. */
export class PlayedHand {
  readonly #client: EgoTouchClient;
  #fingers: readonly Played[] = [];
  readonly #timer: ReturnType<typeof setInterval>;

  constructor(client: EgoTouchClient) {
    this.#client = client;
    this.#timer = setInterval(() => this.#send(), AGAIN_MS);
  }

  /** These fingers are there now: those with a force touch, the others hover. */
  play(...fingers: Played[]): void {
    this.#fingers = fingers;
    this.#send();
  }

  end(): void {
    clearInterval(this.#timer);
  }

  #send(): void {
    const pointers = this.#fingers.map(({ xMm = 0, yMm = 40, forceN = 0, finger = "index", hand = "right", surface = "palm" }) => ({
      id: FINGERS.number(finger),
      hand: HANDS.number(hand),
      finger: FINGERS.number(finger),
      surface: SURFACES.number(surface),
      xMm,
      yMm,
      forceN,
      hoverMm: forceN > 0 ? 0 : 12,
      pitchRad: 0.8,
    }));
    this.#client.send({ case: "simulated", value: { pointers } });
  }
}
