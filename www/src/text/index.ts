// The language of the page: another language is another dictionary here.
import { type Dictionary, en } from './en'

export const text: Dictionary = en
