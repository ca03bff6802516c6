import { addOffered, type Offered, offered, openOffered } from "../models/opening";
import { nameOf } from "../models/sources";
import { slots } from "../state/state";
import { Modal } from "../ui/Modal";

/** Dialog that asks what dropped shapes are: a model of their own, or the shapes of the model that is open. */
export function OfferedShapes() {
  const asked = offered.value;
  return asked && <Dialog key={asked.shapes.serial} asked={asked} />;
}

function Dialog({ asked }: { asked: Offered }) {
  const { side, shapes } = asked;
  const letter = side.toUpperCase();
  const slot = slots[side].value;
  const model = slot ? nameOf(slot.source) : letter;
  // The close event arrives later; another drop may have asked again by then.
  const close = () => {
    if (offered.peek() === asked) offered.value = null;
  };
  return (
    <Modal title={`What are the shapes of “${shapes.name}”?`} onClose={close}>
      <div class="card-row">
        <button type="button" class="primary" onClick={() => void addOffered(asked)}>
          The shapes of {letter}, “{model}”
        </button>
        <button type="button" onClick={() => void openOffered(asked)}>
          A model of their own: open as {letter}
        </button>
      </div>
    </Modal>
  );
}
