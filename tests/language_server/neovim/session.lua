-- A session of an editor: what its user sees is written to the file SESSION, step by step.
local transcript = {}
local function note(...)
  table.insert(transcript, table.concat({ ... }, " "))
end
local function lines()
  return table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), "\n")
end
local function show(title)
  note("== " .. title)
  note(lines())
end
local WAIT = 60000 -- ms, at most

local function problems(wanted)
  vim.wait(WAIT, function() return #vim.diagnostic.get(0) == wanted end, 20)
  for _, found in ipairs(vim.diagnostic.get(0)) do
    local head = found.message:match("[^\n]*")
    note(string.format("%d:%d %s %s", found.lnum + 1, found.col + 1, found.code or "", head))
  end
end

local function ask(method, params)
  local answers, trouble = vim.lsp.buf_request_sync(0, method, params, WAIT)
  assert(answers, trouble)
  for _, answer in pairs(answers) do
    assert(not answer.error, vim.inspect(answer.error))
    return answer.result
  end
end

local function cursor_on(word)
  local row, column
  for number, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    column = line:find(word, 1, true)
    if column then
      row = number
      break
    end
  end
  vim.api.nvim_win_set_cursor(0, { row, column - 1 })
  return vim.lsp.util.make_position_params()
end

local function replace(old, new)
  local text = lines()
  local first, last = text:find(old, 1, true)
  text = text:sub(1, first - 1) .. new .. text:sub(last + 1)
  vim.api.nvim_buf_set_lines(0, 0, -1, false, vim.split(text, "\n"))
end

local function session()
  vim.cmd("edit " .. vim.env.SCENARIO)
  local client = vim.lsp.start_client({
    name = "osc2tx",
    cmd = vim.split(vim.env.SERVER, " "),
    root_dir = vim.fn.getcwd(),
  })
  vim.lsp.buf_attach_client(0, client)
  vim.wait(WAIT, function()
    local found = vim.lsp.get_client_by_id(client)
    return found ~= nil and found.initialized
  end, 20)

  note("== diagnostic")
  problems(1)

  note("== completion behind `leader.`")
  local params = cursor_on("leader.driv(")
  params.position.character = params.position.character + #"leader.driv"
  for _, item in ipairs(ask("textDocument/completion", params)) do
    if vim.startswith(item.label, "driv") then note(item.label) end
  end

  note("== fixes")
  cursor_on("driv(")
  local range = vim.lsp.util.make_range_params()
  range.context = { diagnostics = vim.lsp.diagnostic.get_line_diagnostics() }
  for _, action in ipairs(ask("textDocument/codeAction", range)) do
    note(action.kind, action.title)
  end
  vim.lsp.util.apply_workspace_edit(ask("textDocument/codeAction", range)[1].edit, "utf-16")
  problems(0)
  show("after the fix")

  cursor_on("leader: vehicle")
  vim.lsp.buf.rename("truck")
  vim.wait(WAIT, function() return lines():find("truck.drive", 1, true) ~= nil end, 20)
  show("after renaming `leader` to `truck`")

  replace("speed(50kph)", "speed( 50kph )")
  vim.lsp.buf.formatting_sync(nil, WAIT)
  problems(0)
  show("after formatting")
end

local ok, trouble = pcall(session)
if not ok then note("FAILED", tostring(trouble)) end
local file = io.open(vim.env.SESSION, "w")
file:write(table.concat(transcript, "\n") .. "\n")
file:close()
vim.cmd("qall!")
