/** Opens all answers while the page is printed. Returns a function that ends this. */
export function openForPrint(within: HTMLElement): () => void {
  let folded: HTMLDetailsElement[] = [];
  const before = () => {
    folded = [...within.querySelectorAll<HTMLDetailsElement>("details:not([open])")];
    for (const one of folded) one.open = true;
  };
  const after = () => {
    for (const one of folded) one.open = false;
    folded = [];
  };
  addEventListener("beforeprint", before);
  addEventListener("afterprint", after);
  return () => {
    removeEventListener("beforeprint", before);
    removeEventListener("afterprint", after);
  };
}
