import { useSignal } from "@preact/signals";
import { bibTeX, methods } from "../comparison/methods";
import { saveAsOffered } from "../pictures/FigureDialog";
import { pictureDialog } from "../pictures/PictureDialogs";
import { result } from "../state/state";
import { plain } from "../text/phrase";
import { copyText } from "../ui/download";
import { Phrase } from "../ui/Phrase";

/** Buttons that save figures and animations, and that copy the methods paragraph. */
export function Pictures({ ready }: { ready: boolean }) {
  return (
    <>
      <fieldset class="download-row">
        <legend>Figure</legend>
        <button
          type="button"
          disabled={!ready}
          title="Means of A, B and A∩B, and what each misses of the other, pushed and coloured"
          aria-label="Figure of the contrast .png"
          onClick={() => void saveAsOffered("contrast")}
        >
          contrast
        </button>
        <button
          type="button"
          disabled={!ready}
          title="Five blocks of random shapes, as in the paper"
          aria-label="Figure of random shapes .png"
          onClick={() => void saveAsOffered("shapes")}
        >
          shapes
        </button>
        <button
          type="button"
          disabled={!ready}
          title="Standard deviations of the five regions with one colour bar, as in the paper"
          aria-label="Figure of variance .png"
          onClick={() => void saveAsOffered("variance")}
        >
          variance
        </button>
        <button
          type="button"
          disabled={!ready}
          onClick={() => {
            pictureDialog.value = "figure";
          }}
        >
          other…<span class="unseen"> figure</span>
        </button>
      </fieldset>
      <fieldset class="download-row">
        <legend>Film</legend>
        <button
          type="button"
          disabled={!ready}
          title="Animation of a mode, or of the change from A to B, as GIF or WebM"
          onClick={() => {
            pictureDialog.value = "film";
          }}
        >
          Animation…
        </button>
      </fieldset>
    </>
  );
}

/** Methods paragraph and BibTeX of the comparison, to copy. */
export function Methods() {
  const report = result.value?.report;
  const said = useSignal("");
  if (!report) return null;
  const copy = async (text: string, what: string) => {
    said.value = (await copyText(text)) ? `${what} copied` : "Copy it from the text below";
  };
  const paragraph = methods(report);
  const citations = bibTeX(report.engine);
  return (
    <>
      <fieldset class="download-row">
        <legend>Text</legend>
        <button type="button" onClick={() => void copy(plain(paragraph), "Methods paragraph")}>
          Copy methods paragraph
        </button>
        <button type="button" onClick={() => void copy(citations, "BibTeX")}>
          Copy BibTeX
        </button>
      </fieldset>
      <p class="small" role="status">
        {said.value}
      </p>
      <details class="more methods">
        <summary>Methods paragraph and BibTeX</summary>
        <p class="methods-text">
          <Phrase parts={paragraph} />
        </p>
        <pre>{citations}</pre>
      </details>
    </>
  );
}
