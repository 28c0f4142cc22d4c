// Pointer capture for pointers that the browser does not know: its own `setPointerCapture` refuses their ids.

/** The pointers whose capture is kept here, by DOM id. */
export interface CaptureOwner {
  has(pointerId: number): boolean;
  capture(pointerId: number, element: Element): void;
  release(pointerId: number, element: Element): void;
  holder(pointerId: number): Element | null;
}

const owners = new Set<CaptureOwner>();
let restore: (() => void) | null = null;

const ownerOf = (pointerId: number) => [...owners].find((owner) => owner.has(pointerId));

/** Let an owner answer for its pointers on every element; gives what ends that. */
export function own(owner: CaptureOwner): () => void {
  owners.add(owner);
  restore ??= patch();
  return () => {
    owners.delete(owner);
    if (owners.size) return;
    restore?.();
    restore = null;
  };
}

function patch(): () => void {
  const { setPointerCapture, releasePointerCapture, hasPointerCapture } = Element.prototype;
  Object.assign(Element.prototype, {
    setPointerCapture(this: Element, pointerId: number): void {
      const owner = ownerOf(pointerId);
      if (!owner) return setPointerCapture.call(this, pointerId);
      if (!this.isConnected) throw new DOMException("the element is not in the document", "InvalidStateError");
      return owner.capture(pointerId, this);
    },
    releasePointerCapture(this: Element, pointerId: number): void {
      const owner = ownerOf(pointerId);
      if (owner) owner.release(pointerId, this);
      else releasePointerCapture.call(this, pointerId);
    },
    hasPointerCapture(this: Element, pointerId: number): boolean {
      const owner = ownerOf(pointerId);
      return owner ? owner.holder(pointerId) === this : hasPointerCapture.call(this, pointerId);
    },
  });
  return () => Object.assign(Element.prototype, { setPointerCapture, releasePointerCapture, hasPointerCapture });
}
