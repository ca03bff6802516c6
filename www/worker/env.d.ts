/** What Vite puts into the worker. */
interface ImportMeta {
  readonly env: { readonly DEV: boolean };
}
