import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { CloseIcon } from "../ui/icons";
import type { QrCode } from "./qr";

/** QR code of a link, small beside it or as large as the window. */
export function Qr({ text }: { text: string }) {
  const code = useSignal<QrCode | "too long" | "unavailable" | null>(null);
  const full = useSignal(false);
  useEffect(() => {
    let wanted = true;
    import("./qr").then(
      ({ LONGEST_QR, qrCode }) => {
        if (wanted) code.value = text.length > LONGEST_QR ? "too long" : qrCode(text);
      },
      () => {
        code.value = "unavailable";
      },
    );
    return () => {
      wanted = false;
    };
  }, [text]);
  const found = code.value;
  if (found === "too long" || found === "unavailable") {
    const why =
      found === "too long"
        ? "This link is too long for a QR code that cameras can read from a distance."
        : "The part of the page that draws QR codes cannot be loaded: load the page again.";
    return <p class="small share-qr">{why}</p>;
  }
  return (
    <div class="share-qr">
      {found && <Drawing code={found} />}
      <button
        type="button"
        disabled={!found}
        onClick={() => {
          full.value = true;
        }}
      >
        Fill the screen
      </button>
      {found && full.value && (
        <FullScreen
          code={found}
          onClose={() => {
            full.value = false;
          }}
        />
      )}
    </div>
  );
}

/** The code in dark on white in both themes: many cameras read no others. */
function Drawing({ code: { size, path } }: { code: QrCode }) {
  return (
    <svg
      class="qr"
      viewBox={`0 0 ${size} ${size}`}
      style={{ "--modules": size }}
      role="img"
      aria-label="QR code of the link"
      shape-rendering="crispEdges"
    >
      <rect width={size} height={size} fill="#fff" />
      <path d={path} fill="#000" />
    </svg>
  );
}

function FullScreen({ code, onClose }: { code: QrCode; onClose: () => void }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  return (
    <dialog ref={dialog} class="qr-full" aria-label="QR code of the link" onClose={onClose}>
      <Drawing code={code} />
      <button
        type="button"
        class="quiet icon-only"
        aria-label="Close the QR code"
        onClick={() => dialog.current?.close()}
      >
        <CloseIcon />
      </button>
    </dialog>
  );
}
