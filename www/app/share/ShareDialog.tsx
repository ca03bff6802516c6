import { signal } from "@preact/signals";
import { sharedAddress } from "../link/history";
import { namesInLinks } from "../state/state";
import { Check } from "../ui/Check";
import { CopyButton } from "../ui/CopyButton";
import { Modal } from "../ui/Modal";
import { Qr } from "./Qr";
import { elementSnippet, frameSnippet } from "./snippets";
import { type Line, type Subject, subject } from "./subject";

export const sharing = signal(false);

/** Dialog that shares what the page shows: as a link, a QR code, a frame for other pages, a command. */
export function ShareDialog() {
  if (!sharing.value) return null;
  const address = sharedAddress();
  const shared = subject();
  return (
    <Modal
      title={shared.title}
      onClose={() => {
        sharing.value = false;
      }}
    >
      <div class="share">
        <LinkPart address={address} shared={shared} />
        <Qr text={address} />
      </div>
      <Embedding address={address} shared={shared} />
      {shared.command && <AsCommand command={shared.command} />}
    </Modal>
  );
}

interface Props {
  address: string;
  shared: Subject;
}

function LinkPart({ address, shared: { holds, copied, lost } }: Props) {
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
          done={copied}
        />
        {share && (
          <button type="button" onClick={share}>
            Send…
          </button>
        )}
      </div>
      {holds.map((sentence) => (
        <p key={sentence} class="small">
          {sentence}
        </p>
      ))}
      {lost.files.length > 0 && <Names />}
    </div>
  );
}

/** Chooses whether links contain the names of the visitor's files. */
function Names() {
  return (
    <Check
      checked={namesInLinks.value}
      onChange={(checked) => {
        namesInLinks.value = checked;
      }}
    >
      With the names of the files, also in the address bar
    </Check>
  );
}

/** Shares a link with the dialog of the system. Closing that dialog is no error. */
async function sendOn(url: string): Promise<void> {
  await navigator.share({ title: document.title, url }).catch(() => undefined);
}

function Embedding({ address, shared: { name, framed } }: Props) {
  const element = elementSnippet(address, name);
  const frame = frameSnippet(sharedAddress(true), name);
  return (
    <details class="more">
      <summary>In another web page</summary>
      <div class="share-parts">
        <p class="small">{framed} It is 420 pixels high unless the page says otherwise.</p>
        <Snippet label="As an element" text={element} />
        <Snippet label="Where no scripts are allowed" text={frame} />
      </div>
    </details>
  );
}

function AsCommand({ command: { text, files, missing } }: { command: Line }) {
  return (
    <details class="more">
      <summary>On the command line</summary>
      <div class="share-parts">
        <Snippet label="The same numbers from a terminal" text={text} />
        {files.length > 0 && (
          <p class="small">Run it in the folder that holds {files.join(" and ")}.</p>
        )}
        {missing.length > 0 && (
          <p class="small">
            The command does not contain {missing.join(" and ")}: use a run file with{" "}
            <code>shapevenn compare --run</code> instead.
          </p>
        )}
      </div>
    </details>
  );
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
