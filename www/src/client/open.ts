// Opens the core: in a worker where that is allowed, else on the main thread.
import type { Start } from '../shared/protocol'
import { wasmBytes } from '../place'
import type { Client } from './client'
import { LocalClient } from './local'
import { WorkerClient } from './worker'

export async function openCore(): Promise<{ client: Client; start: Start }> {
  const wasm = await wasmBytes('laboratory')
  try {
    const client = await WorkerClient.open()
    return { client, start: await client.ask('start', { wasm }) }
  } catch {
    const client = new LocalClient()
    return { client, start: await client.ask('start', { wasm }) }
  }
}
