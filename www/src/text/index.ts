// The language of the page.
import { type Dictionary, en } from './en'

export const text: Dictionary = en
