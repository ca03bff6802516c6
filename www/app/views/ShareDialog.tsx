import { signal } from "@preact/signals";
import { sharedAddress, unlinkable } from "../history";
import { plain } from "../phrase";
import { commandOf } from "../share/command";
import { copiedWords, holdsSentences } from "../share/holds";
import { elementSnippet, frameSnippet } from "../share/snippets";
import { nameOf } from "../sources";
import { namesInLinks, nouns, result, type Side, settings, slots } from "../state";
import { headline } from "../words";
import { CopyButton } from "./CopyButton";
import { Modal } from "./Modal";
import { Qr } from "./Qr";

export const sharing = signal(false);

/** The comparison for somebody else: as a link, a code to photograph, a frame, a command. */
export function ShareDialog() {
  if (!sharing.value) return null;
  const address = sharedAddress();
  return (
    <Modal
      title="Share this comparison"
      onClose={() => {
        sharing.value = false;
      }}
    >
      <div class="share">
        <LinkPart address={address} />
        <Qr text={address} />
      </div>
      <Embedding address={address} />
      <AsCommand />
    </Modal>
  );
}

function LinkPart({ address }: { address: string }) {
  const lost = unlinkable.value;
  const share = "share" in navigator ? () => void sendOn(address) : null;
  return (
    <div class="share-link">
      <label class="share-field">
        <span>
          Link <span class="dim">({address.length} characters)</span>
        </span>
        <textarea
          readOnly
          rows={3}
          value={address}
          onFocus={(event) => event.currentTarget.select()}
        />
      </label>
      <div class="card-row">
        <CopyButton
          label="Copy link"
          primary
          autofocus
          text={() => sharedAddress()}
          done={copiedWords(lost)}
        />
        {share && (
          <button type="button" onClick={share}>
            Send…
          </button>
        )}
      </div>
      {holdsSentences(lost).map((sentence) => (
        <p key={sentence} class="small">
          {sentence}
        </p>
      ))}
      {lost.files.length > 0 && <Names />}
    </div>
  );
}

/** What is in a link is sent to no server, but links are passed on. */
function Names() {
  return (
    <label class="check">
      <input
        type="checkbox"
        checked={namesInLinks.value}
        onChange={(event) => {
          namesInLinks.value = event.currentTarget.checked;
        }}
      />
      With the names of the files, also in the address bar
    </label>
  );
}

/** By the system's own dialog. Who closes that has changed their mind: nothing went wrong. */
async function sendOn(url: string): Promise<void> {
  await navigator.share({ title: document.title, url }).catch(() => undefined);
}

function Embedding({ address }: { address: string }) {
  const title = `Shapevenn: ${nouns.value.a} and ${nouns.value.b}`;
  const element = elementSnippet(address, title);
  const frame = frameSnippet(sharedAddress(true), title);
  const shown = result.value;
  return (
    <details class="more">
      <summary>In another web page</summary>
      <div class="share-parts">
        <p class="small">
          A frame with the shapes
          {shown && `, the sentence “${plain(headline(shown.report, shown.nouns))}”`} and a link to
          here. It is 420 pixels high unless the page says otherwise.
        </p>
        <Snippet label="As an element" text={element} />
        <Snippet label="Where no scripts are allowed" text={frame} />
      </div>
    </details>
  );
}

function AsCommand() {
  const [a, b] = [commandModel("a"), commandModel("b")];
  if (!a || !b) return null;
  const { line, missing } = commandOf(settings.value, { a, b });
  const from = [a, b]
    .filter(({ source }) => !source.startsWith("demo:"))
    .map(({ source }) => source);
  return (
    <details class="more">
      <summary>On the command line</summary>
      <div class="share-parts">
        <Snippet label="The same numbers from a terminal" text={line} />
        {from.length > 0 && (
          <p class="small">Run it in the folder that holds {[...new Set(from)].join(" and ")}.</p>
        )}
        {missing.length > 0 && (
          <p class="small">
            It cannot say {missing.join(" and ")}: take a run file instead, and{" "}
            <code>shapevenn compare --run</code>.
          </p>
        )}
      </div>
    </details>
  );
}

function commandModel(side: Side) {
  const slot = slots[side].value;
  if (!slot) return null;
  const { source, part, parts, scale } = slot;
  return {
    source: source.kind === "demo" ? `demo:${source.name}` : nameOf(source),
    part: part === parts[0] ? null : part,
    scale,
  };
}

function Snippet({ label, text }: { label: string; text: string }) {
  return (
    <div class="snippet">
      <label class="share-field">
        <span>{label}</span>
        <textarea
          readOnly
          rows={Math.min(5, Math.ceil(text.length / 78))}
          spellcheck={false}
          value={text}
          onFocus={(event) => event.currentTarget.select()}
        />
      </label>
      <CopyButton label="Copy" text={() => text} />
    </div>
  );
}
