import { useSignal } from "@preact/signals";
import type { FunctionComponent } from "preact";
import { useEffect } from "preact/hooks";

/** Loads a page when it is opened. */
export function Later({ load }: { load: () => Promise<FunctionComponent> }) {
  const found = useSignal<{ Page: FunctionComponent } | "failed" | null>(null);
  useEffect(() => {
    load().then(
      (Page) => {
        found.value = { Page };
      },
      () => {
        found.value = "failed";
      },
    );
  }, [load]);
  if (found.value === null) return <main class="later" aria-busy="true" />;
  if (found.value === "failed") {
    return (
      <main class="later">
        <p role="alert">
          This part of the page cannot be loaded. Check the connection and reload the page; the
          comparison stays unchanged until then.
        </p>
      </main>
    );
  }
  const { Page } = found.value;
  return <Page />;
}
