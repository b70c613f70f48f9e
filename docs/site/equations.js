// Typesets what arithmatex marks as equations.
window.addEventListener("DOMContentLoaded", () => {
  const delimiters = [{ left: "\\(", right: "\\)", display: false }, { left: "\\[", right: "\\]", display: true }];
  for (const equation of document.querySelectorAll(".arithmatex")) renderMathInElement(equation, { delimiters });
});
