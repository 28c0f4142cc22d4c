// The list of events, newest first, coloured and filtered by group. Moves are counted elsewhere and listed only when asked for.

import { isStream } from "./connection.js";
import { GROUP_OF, GROUPS, words } from "./vocabulary.js";

const KEPT = 150;
const STREAM = "stream";

export class EventLog {
  #list;
  #hidden = new Set([STREAM]);
  #first = null;

  /** `list` is an <ol>, `filters` the element that takes the filter buttons. */
  constructor(list, filters) {
    this.#list = list;
    for (const [key, { label, colour }] of Object.entries(GROUPS)) filters.append(this.#filterButton(key, label, colour));
    filters.append(this.#filterButton(STREAM, "Moves", "#93a4b8"));
  }

  /** List events in order. */
  add(events, local) {
    const rows = events.map((event) => this.#row(event, local)).reverse();
    this.#list.prepend(...rows);
    while (this.#list.childElementCount > KEPT) this.#list.lastElementChild.remove();
  }

  clear() {
    this.#list.replaceChildren();
  }

  #filterButton(key, label, colour) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "chip";
    button.textContent = label;
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

  #row(event, local) {
    this.#first ??= event.timestampMs;
    const row = document.createElement("li");
    row.className = `group-${GROUP_OF[event.type]}${isStream(event.type) ? ` group-${STREAM}` : ""}${local || event.late ? " apart" : ""}`;
    row.append(
      cell("when", `${((event.timestampMs - this.#first) / 1000).toFixed(2)} s`),
      cell("what", words(event.type)),
      cell("who", `${words(event.hand)} ${words(event.finger)}`),
      cell("where", `${words(event.surface)} ${event.xMm.toFixed(0)}, ${event.yMm.toFixed(0)} mm`),
      cell("more", remarks(event, local)),
    );
    return row;
  }
}

function remarks(event, local) {
  const said = [];
  if (event.forceN > 0) said.push(`${event.forceN.toFixed(2)} N`);
  if (event.clickCount > 1) said.push(`× ${event.clickCount}`);
  if (event.reason) said.push(words(event.reason));
  if (local) said.push("by this page");
  if (event.late) said.push("late, must not act");
  return said.join(" · ");
}

function cell(kind, text) {
  const element = document.createElement("span");
  element.className = kind;
  element.textContent = text;
  return element;
}
