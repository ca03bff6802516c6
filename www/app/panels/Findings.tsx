import type { Finding, ModelReport, Side } from "../../worker/protocol";
import { chooseReading } from "../models/opening";
import { CloseIcon } from "../ui/icons";

/** What the engine found unusual in a file, with other ways to read it, and what was chosen so far. */
export function Findings({ side, report }: { side: Side; report: ModelReport }) {
  const { findings = [], applied = [] } = report;
  return (
    <>
      {findings.map((finding) => (
        <Found key={finding.code} side={side} finding={finding} />
      ))}
      {applied.length > 0 && (
        <ul class="chips" aria-label={`How model ${side.toUpperCase()} is read`}>
          {applied.map(({ sentence, undo }) => (
            <li key={sentence} class="chip">
              <span>{sentence}</span>
              <button
                type="button"
                class="quiet icon-only"
                aria-label={`Undo: ${sentence}`}
                onClick={() => void chooseReading(side, undo)}
              >
                <CloseIcon />
              </button>
            </li>
          ))}
        </ul>
      )}
    </>
  );
}

function Found({ side, finding }: { side: Side; finding: Finding }) {
  const { code, message, doubt, choices } = finding;
  return (
    <div class="finding" data-doubt={doubt} data-code={code}>
      <p>{message}</p>
      {choices.map(({ label, reading }) => (
        <button key={label} type="button" onClick={() => void chooseReading(side, reading)}>
          {label}
        </button>
      ))}
    </div>
  );
}
