/**
 * Runs one asynchronous call at a time; of the calls that are requested meanwhile only the latest follows.
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
    // The caller reports errors.
    ask(value).then(done, done);
  };
  return (value) => {
    if (asking) waiting = { value };
    else next(value);
  };
}
