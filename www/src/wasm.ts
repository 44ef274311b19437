// The compiled core beside the page. The one-file page takes wasm.inline.ts instead: the build replaces the name
// '../wasm', so only one file may import it.
import url from '../pkg/ringroad_bg.wasm?url'

export const wasmBytes = async (): Promise<ArrayBuffer> => {
  const response = await fetch(url)
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`)
  return response.arrayBuffer()
}
