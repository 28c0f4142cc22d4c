/** What went wrong, by kind: a setting, a message of the server, a consumer that is too slow, or the event grammar. */
export type ErrorCode = "config" | "protocol" | "too_slow" | "grammar" | "device";

/** Every error of this package: `code` says which kind, `hint` what to do next. */
export class EgoTouchError extends Error {
  readonly code: ErrorCode;
  readonly hint: string;

  constructor(code: ErrorCode, message: string, hint = "") {
    super(hint ? `${message}. ${hint}` : message);
    this.name = "EgoTouchError";
    this.code = code;
    this.hint = hint;
  }
}
