import type { Phrase as Parts } from "../text/phrase";

/** Renders a sentence whose numbers carry their path in the report. */
export function Phrase({ parts }: { parts: Parts }) {
  return (
    <>
      {/* A number may stand in it twice. */}
      {parts.map((part, i) =>
        typeof part === "string" ? (
          part
        ) : (
          <Metric key={i} path={part.metric} value={part.value} text={part.text} />
        ),
      )}
    </>
  );
}

export function Metric({ path, value, text }: { path: string; value: number; text: string }) {
  return (
    <data class="metric" value={String(value)} data-metric={path} data-value={String(value)}>
      {text}
    </data>
  );
}
