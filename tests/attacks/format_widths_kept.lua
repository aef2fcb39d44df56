-- expects: harmless
for _, spec in ipairs { "%99.99f", "%-99.99e", "%+099d", "%#99x", "% 99o", "%99.99g", "%99s", "%.99s" } do
  for _, x in ipairs { 0, -1, math.huge, -math.huge, 0 / 0, 1.7976931348623157e308, math.mininteger } do
    pcall(string.format, spec, x)
  end
end
return machine { name = "m", start = "A", states = { A = { steer = hold } } }
