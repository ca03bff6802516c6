export function YoursScene() {
  return <p>To come.</p>;
}
