// A lesson in a course page: a frame as high as it needs to be, as docs/embedding.md has it.

const ENTITIES = { '&': '&amp;', '<': '&lt;', '"': '&quot;' };

/** @param {string} words  in an attribute */
const quoted = (words) => words.replace(/[&<"]/g, (sign) => ENTITIES[/** @type {keyof typeof ENTITIES} */ (sign)]);

/**
 * @param {import('../lesson/lesson.js').Record_} record
 * @param {string} [base]  address of the page
 */
export function frameOf({ lesson, title, title_before: before }, base = window.location.href) {
  const { href } = new URL(`?embed&lesson=${lesson}`, base);
  return `<iframe class="strikewave" src="${quoted(href)}" title="${quoted(before || title)}"
  width="100%" height="720" style="border: 0" allow="clipboard-write"></iframe>
<script>
  window.addEventListener('message', ({ data, source }) => {
    if (data?.strikewave !== 1 || !(data.height > 0)) return;
    for (const frame of document.querySelectorAll('iframe.strikewave'))
      if (frame.contentWindow === source) frame.height = Math.min(data.height, 4000);
  });
</script>
`;
}
