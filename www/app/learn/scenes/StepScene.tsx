export function StepScene() {
  return <p>To come.</p>;
}
