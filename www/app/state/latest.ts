/**
 * Questions that come faster than answers: one at a time, and of those that wait only the latest.
 * The answer to a question that was overtaken is passed on too, so that a picture moves along.
 */
export function latest<T>(ask: (value: T) => Promise<void>): (value: T) => void {
  let asking = false;
  let waiting: { value: T } | null = null;
  const next = (value: T) => {
    asking = true;
    const done = () => {
      asking = false;
      const then = waiting;
      waiting = null;
      if (then) next(then.value);
    };
    // Whoever asks says what went wrong; here it only is over.
    ask(value).then(done, done);
  };
  return (value) => {
    if (asking) waiting = { value };
    else next(value);
  };
}
