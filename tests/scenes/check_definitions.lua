-- Checks definitions for lua-language-server, as `jostle reference lua-ls` prints them, by stock Lua:
--   lua5.4 check_definitions.lua DEFINITIONS REFERENCE
-- They must be Lua; each annotation must be well-formed, each class that is named defined, and the parameters of each
-- function annotated in their order; each word, key, parameter, field and function of tests that REFERENCE (the page
-- `jostle reference behaviours`) has must be there, with a type. Prints each fault; the status is their number, at most 99.

local function read(path)
  local file = assert(io.open(path))
  local text = file:read("a")
  file:close()
  return text
end
local text, page = read(arg[1]), read(arg[2])
local faults = 0
local function fault(...)
  print(string.format(...))
  faults = faults + 1
end

-- ---- types ----

local BUILTIN = { any = true, string = true, number = true, integer = true, boolean = true, table = true, ["nil"] = true,
  fun = true }
local named = {} -- class = line where it is named
local generic = {} -- of the present function

local parse_type

-- Parses "name: T, name?: T, ..." up to ")"; returns the position after it, or nil.
local function parse_parameters(s, at)
  at = s:match("^%s*()", at)
  while s:sub(at, at) ~= ")" do
    local after = s:match("^[%a_][%w_]*%??%s*:%s*()", at) or s:match("^%.%.%.%s*:%s*()", at)
    at = after and parse_type(s, after)
    if not at then return nil end
    at = s:match("^%s*,%s*()", at) or s:match("^%s*()", at)
  end
  return at + 1
end

-- Parses a type at a position without its alternatives; returns the position after it, or nil.
local function parse_one(s, at, line)
  local after = s:match('^"[^"]*"()', at)
  if not after and s:sub(at, at) == "(" then
    after = parse_type(s, at + 1, line)
    after = after and s:match("^%)()", after)
  elseif not after and s:match("^fun%(", at) then
    after = parse_parameters(s, at + 4)
    local results = after and s:match("^%s*:%s*()", after)
    while results do
      after = parse_type(s, results, line)
      results = after and s:match("^,%s*()[%a\"(]", after)
      -- a comma may also belong to the text around it: only types that are known go on
      if results and not BUILTIN[s:match("^[%w_.]+", results) or ""] then results = nil end
    end
  elseif not after then
    local name
    name, after = s:match("^([%a_][%w_.]*)()", at)
    if not name then return nil end
    if not BUILTIN[name] and not generic[name] then named[name] = named[name] or line end
    local inner = s:match("^<()", after)
    while inner do
      after = parse_type(s, inner, line)
      inner = after and s:match("^,%s*()", after)
      if after and not inner then after = s:match("^>()", after) end
    end
  end
  while after and s:match("^%[%]", after) do after = after + 2 end
  return after
end

function parse_type(s, at, line)
  at = parse_one(s, at, line)
  while at and s:sub(at, at) == "|" do at = parse_one(s, at + 1, line) end
  return at
end

-- Parses a type that ends at a blank or the end of the text; returns it.
local function type_at(s, at, line)
  local after = parse_type(s, at, line)
  if not after or not s:match("^%s", after) and after <= #s then return nil end
  return s:sub(at, after - 1), after
end

-- ---- annotations ----

local classes, fields, globals, methods = {}, {}, {}, {}
local class, params, number = nil, {}, 0
local OPERATORS = { band = 1, bor = 1, bnot = 0, add = 1, sub = 1, mul = 1, div = 1, unm = 0 }

local READERS = {}
function READERS.meta(s) return s == "" end
function READERS.class(s)
  local name, parents = s:match("^([%w_.]+)%s*:?%s*(.*)$")
  if not name then return false end
  class = name
  fields[class] = fields[class] or {}
  if classes[name] then fault("%d: class %s is defined twice", number, name) end
  classes[name] = true
  for parent in parents:gmatch("[^,%s]+") do named[parent] = named[parent] or number end
  return parents == "" or parents:match("^[%w_.]+[%w_., ]*$") ~= nil
end
function READERS.alias(s)
  local name, at = s:match("^([%w_.]+)%s+()")
  if not name then return false end
  classes[name] = true
  return type_at(s, at, number) ~= nil
end
function READERS.field(s)
  local name, at = s:match("^([%a_][%w_]*)%??%s+()")
  if not name then
    name, at = s:match("^%[(%w+)%]%s+()")
    if name and not name:match("^%d+$") and name ~= "string" and name ~= "integer" then return false end
    name = name and "[" .. name .. "]"
  end
  local kind = name and type_at(s, at, number)
  if not kind or not class then return false end
  if fields[class][name] then fault("%d: field %s of %s is defined twice", number, name, class) end
  fields[class][name] = kind
  return true
end
function READERS.operator(s)
  local name, at = s:match("^(%a+)()")
  if not name or not OPERATORS[name] then return false end
  if OPERATORS[name] == 1 then
    at = s:match("^%(()", at)
    at = at and parse_type(s, at, number)
    at = at and s:match("^%)()", at)
  end
  at = at and s:match("^: ()", at)
  return at ~= nil and type_at(s, at, number) ~= nil
end
function READERS.generic(s)
  local name, at = s:match("^(%u)%s*:%s*()")
  if not name then return false end
  generic[name] = true
  return type_at(s, at, number) ~= nil
end
function READERS.param(s)
  local name, at = s:match("^([%a_][%w_]*)%??%s+()")
  if not name then
    at = s:match("^%.%.%.%s+()")
    name = at and "..."
  end
  local kind = name and type_at(s, at, number)
  params[#params + 1] = name
  return kind ~= nil
end
READERS["return"] = function(s) return type_at(s, 1, number) ~= nil end
function READERS.overload(s) return s:match("^fun%(") ~= nil and type_at(s, 1, number) ~= nil end
READERS.type = READERS["return"]

-- Reads the head of a function, whose parameters must be those annotated before it.
local function read_function(line)
  local name, list = line:match("^function ([%w_.:]+)%(([^)]*)%) end$")
  if not name then return fault("%d: no function can be read in: %s", number, line) end
  local n = 0
  for parameter in list:gmatch("[^,%s]+") do
    n = n + 1
    if params[n] ~= parameter then
      fault("%d: parameter %d of %s is '%s', annotated as '%s'", number, n, name, parameter, params[n] or "nothing")
    end
  end
  if #params ~= n then fault("%d: %s takes %d parameters, and %d are annotated", number, name, n, #params) end
  local owner, method = name:match("^(%a+):([%a_]+)$")
  if owner then methods["jostle." .. owner .. ":" .. method] = true else globals[name] = true end
  params, generic = {}, {}
end

for line in text:gmatch("([^\n]*)\n") do
  number = number + 1
  local word, rest = line:match("^%-%-%-@([%a]+)%s*(.*)$")
  if line:match("^%-%-%-@") then
    if not word or not READERS[word] or not READERS[word](rest) then fault("%d: cannot be read: %s", number, line) end
  elseif line:match("^function") then
    read_function(line)
  elseif line:match("^[%a_][%w_]* = nil$") then
    globals[line:match("^[%w_]+")] = true
  elseif line ~= "" and not line:match("^%-%-") and not line:match("^local %a+ = {}$") then
    fault("%d: unexpected: %s", number, line)
  end
end
for name, at in pairs(named) do
  if not classes[name] then fault("%d: there is no class %s", at, name) end
end
local chunk, why = load(text)
if not chunk then fault("it is no Lua: %s", why) end

-- ---- what must be there ----

local function field_of(owner, name, what)
  local kind = fields["jostle." .. owner] and fields["jostle." .. owner][name]
  if not kind then fault("%s '%s' is missing in %s", what, name, owner) end
  if kind == "any" then fault("%s '%s' of %s has no type", what, name, owner) end
end
local TABLES = { ["machine { ... }"] = "Machine", ["A state"] = "State", ["A transition"] = "Transition" }
local LUAS_OWN = { require = true, print = true }
local section, part, counted = "", "", 0
for line in page:gmatch("([^\n]*)\n") do
  section, part = line:match("^## (.*)") or section, line:match("^###? (.*)") or part
  local cell = line:match("^| `([^`]+)` |")
  local name = cell and cell:match("^[%a_]+")
  if cell and section == "Words" then
    counted = counted + 1
    local filter, prefixed = cell:match("^of:([%a_]+)"), cell:match("^[%a_]+")
    if filter then
      if not methods["jostle.Target:" .. filter] then fault("filter '%s' is missing", filter) end
    elseif not globals[prefixed] and not LUAS_OWN[prefixed] then
      fault("word '%s' is missing", prefixed)
    end
  elseif cell and section == "Parameters" then
    counted = counted + 1
    for _, owner in ipairs { "Parameters", "View", "TestAgent", "Own" } do field_of(owner, name, "parameter") end
    if name ~= "neighbours" then field_of("Me", name, "parameter") end
  elseif cell and section == "Tables" then
    counted = counted + 1
    local owner = TABLES[part] or part:match("^(%a+) =")
    field_of(owner:sub(1, 1):upper() .. owner:sub(2), name, "key")
  elseif cell and section == "Functions" then
    counted = counted + 1
    field_of(name == "in_sight" and "View" or "Me", name, "field of me")
  elseif cell and section == "Tests" and cell:match("%(") then
    counted = counted + 1
    local method = cell:match("^s:([%a_]+)")
    if method and not methods["jostle.Scene:" .. method] then fault("method '%s' of tests is missing", method) end
    if not method and not globals[name] then fault("function '%s' of tests is missing", name) end
  end
end
for name in (page:match("NAME is one of ([%a_ ]+)") or ""):gmatch("[%a_]+") do
  counted = counted + 1
  field_of("Now", name, "measure")
  field_of("Target", name, "measure")
end
if counted < 200 then fault("only %d words and keys were found on the page", counted) end
if faults == 0 then print(counted .. " words and keys are there") end
os.exit(math.min(faults, 99))
