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
    const listed = this.#hidden.has(STREAM) ? events.filter((event) => !isStream(event.type)) : events;
    const rows = listed.map((event) => this.#row(event, local)).reverse();
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
    this.#first ??= event.timestamp_ms;
    const row = document.createElement("li");
    row.className = `group-${GROUP_OF[event.type] ?? "touch"}${isStream(event.type) ? ` group-${STREAM}` : ""}${local || event.late ? " apart" : ""}`;
    row.append(
      cell("when", `${((event.timestamp_ms - this.#first) / 1000).toFixed(2)} s`),
      cell("what", words(event.type)),
      cell("who", `${words(event.hand)} ${words(event.finger)}`),
      cell("more", remarks(event, local)),
      cell("where", `${words(event.surface)} · x ${event.x_mm.toFixed(0)}, y ${event.y_mm.toFixed(0)} mm`),
    );
    return row;
  }
}

function remarks(event, local) {
  const said = [];
  if (event.force_n > 0) said.push(`${event.force_n.toFixed(2)} N`);
  if (event.click_count > 1) said.push(`× ${event.click_count}`);
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
