import { dismiss, notices, type ShownNotice } from "../state/state";
import { CloseIcon } from "./icons";

/** Scrolls to a notice, which may be out of view on a small screen. */
export function showNotice(element: HTMLElement | null): void {
  element?.scrollIntoView({ block: "nearest" });
}

/** Error messages, next to the part of the page that they concern. */
export function Notices({ place }: { place: ShownNotice["place"] }) {
  const found = notices.value.filter((notice) => notice.place === place);
  return (
    <>
      {found.map((notice) => (
        <div key={notice.id} ref={showNotice} class="notice" role="alert" data-code={notice.code}>
          <div>
            {notice.message.split("\n").map((line) => (
              <p key={line} class="notice-message">
                {line}
              </p>
            ))}
            {notice.hint && <p class="notice-hint">{notice.hint}</p>}
            {notice.again && (
              <button type="button" class="notice-again" onClick={notice.again}>
                Try again
              </button>
            )}
            {notice.choices?.map(({ label, act }) => (
              <button key={label} type="button" class="notice-again" onClick={act}>
                {label}
              </button>
            ))}
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
