import { dismiss, type Notice, notices } from "../state/state";
import { CloseIcon } from "./icons";

/** On a small screen what it concerns may be far away. */
export function showNotice(element: HTMLElement | null): void {
  element?.scrollIntoView({ block: "nearest" });
}

/** What went wrong, beside what it concerns. */
export function Notices({ place }: { place: Notice["place"] }) {
  const found = notices.value.filter((notice) => notice.place === place);
  return (
    <>
      {found.map((notice) => (
        <div key={notice.id} ref={showNotice} class="notice" role="alert" data-code={notice.code}>
          <div>
            <p class="notice-message">{notice.message}</p>
            {notice.hint && <p class="notice-hint">{notice.hint}</p>}
            {notice.again && (
              <button type="button" class="notice-again" onClick={notice.again}>
                Try again
              </button>
            )}
          </div>
          <button
            type="button"
            class="quiet icon-only"
            onClick={() => dismiss(place)}
            aria-label="Dismiss"
          >
            <CloseIcon />
          </button>
        </div>
      ))}
    </>
  );
}
