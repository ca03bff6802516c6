export function TeacherScene() {
  return <p>To come.</p>;
}
