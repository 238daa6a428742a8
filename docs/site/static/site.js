// A live page takes the place of its picture when its button is pressed.
document.addEventListener("click", (event) => {
  const button = event.target.closest("button[data-live]");
  if (!button) return;
  const frame = document.createElement("iframe");
  frame.src = button.dataset.live;
  frame.title = button.dataset.title;
  const box = button.closest(".live");
  box.classList.remove("still");
  box.replaceChildren(frame);
  frame.focus();
});
