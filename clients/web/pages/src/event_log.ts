// The list of events, newest first, coloured and filtered by group. Moves are counted elsewhere and listed only when asked for.

import { isStream, type TouchEvent } from "../../src/index.js";
import { GROUP_OF, GROUPS, whole, words } from "./vocabulary.js";

const KEPT = 150;
const STREAM = "stream";

export class EventLog {
  readonly #list: HTMLElement;
  readonly #hidden = new Set([STREAM]);
  #firstNs: bigint | null = null;

  /** `list` is an <ol>, `filters` the element that takes the filter buttons. */
  constructor(list: HTMLElement, filters: HTMLElement) {
    this.#list = list;
    for (const [key, { label, colour }] of Object.entries(GROUPS)) filters.append(this.#filterButton(key, label, colour));
    filters.append(this.#filterButton(STREAM, "Moves", "#93a4b8"));
  }

  /** List events in order. */
  add(events: readonly TouchEvent[]): void {
    const listed = this.#hidden.has(STREAM) ? events.filter((event) => !isStream(event.type)) : events;
    this.#list.prepend(...listed.map((event) => this.#row(event)).reverse());
    while (this.#list.childElementCount > KEPT) this.#list.lastElementChild?.remove();
  }

  clear(): void {
    this.#list.replaceChildren();
  }

  #filterButton(key: string, label: string, colour: string): HTMLElement {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", className: "chip", textContent: label });
    button.style.setProperty("--chip", colour);
    const show = () => {
      button.setAttribute("aria-pressed", String(!this.#hidden.has(key)));
      this.#list.classList.toggle(`hide-${key}`, this.#hidden.has(key));
    };
    button.addEventListener("click", () => {
      if (!this.#hidden.delete(key)) this.#hidden.add(key);
      show();
    });
    show();
    return button;
  }

  #row(event: TouchEvent): HTMLElement {
    this.#firstNs ??= event.timestampNs;
    const row = document.createElement("li");
    row.className = [`group-${GROUP_OF[event.type]}`, isStream(event.type) ? `group-${STREAM}` : "", event.local || event.late ? "apart" : ""].join(" ").trim();
    row.append(
      cell("when", `${(Number(event.timestampNs - this.#firstNs) / 1e9).toFixed(2)} s`),
      cell("what", words(event.type)),
      cell("who", `${words(event.hand)} ${words(event.finger)}`),
      cell("more", remarks(event)),
      cell("where", `${words(event.surface)} · x ${whole(event.xMm)}, y ${whole(event.yMm)} mm`),
    );
    return row;
  }
}

function remarks(event: TouchEvent): string {
  const said: string[] = [];
  if (event.forceN > 0) said.push(`${event.forceN.toFixed(2)} N`);
  if (event.clickCount > 1) said.push(`× ${event.clickCount}`);
  if (event.reason) said.push(words(event.reason));
  if (event.local) said.push("by this page");
  if (event.late) said.push("late, must not act");
  return said.join(" · ");
}

function cell(kind: string, text: string): HTMLElement {
  const element = document.createElement("span");
  element.className = kind;
  element.textContent = text;
  return element;
}
