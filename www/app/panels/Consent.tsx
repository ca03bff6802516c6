import { questions, UNASKED_BYTES } from "../models/address/consent";
import { bytes } from "../text/format";
import { showNotice } from "../ui/Notices";

/** Asks before a large file is downloaded. The open models stay open, whatever the answer is. */
export function Consent() {
  return (
    <>
      {questions.value.map((question) => {
        const { name, host, answer } = question;
        const size =
          question.bytes === null ? `more than ${bytes(UNASKED_BYTES)}` : bytes(question.bytes);
        return (
          <div key={`${host}/${name}`} ref={showNotice} class="consent" role="alert">
            <p>
              <strong>{name}</strong> on {host} is {size}. Download it?
            </p>
            <div class="card-row">
              <button type="button" class="primary" onClick={() => answer(true)}>
                Download<span class="unseen"> {name}</span>
              </button>
              <button type="button" onClick={() => answer(false)}>
                Not now
              </button>
            </div>
          </div>
        );
      })}
    </>
  );
}
