// Search by words, as `percuss materials` has it.

// Whether a text has all words; one of one or two letters, the symbol of an element, is a word of its own and no part of others.
export function holds(text: string, words: string): boolean {
  const parts = text.split(/\s+/);
  return words.toLowerCase().split(/\s+/).filter((word) => word).every((word) => (word.length > 2 ? text.includes(word) : parts.includes(word)));
}
