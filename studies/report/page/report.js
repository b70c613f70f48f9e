(function () {
  var table = document.querySelector('table.runs');
  if (!table) return;
  var body = table.tBodies[0], rows = Array.prototype.slice.call(body.rows);
  var bar = document.querySelector('.filter');
  bar.hidden = false;
  var words = bar.querySelector('input'), shown = bar.querySelector('output');
  var choices = Array.prototype.slice.call(bar.querySelectorAll('select'));
  function apply() {
    var wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean), count = 0;
    rows.forEach(function (row) {
      var text = row.textContent.toLowerCase();
      var fits = wanted.every(function (word) { return text.indexOf(word) >= 0; }) &&
        choices.every(function (choice) {
          return choice.value === '' || row.dataset[choice.name].split(' ').indexOf(choice.value) >= 0;
        });
      row.hidden = !fits;
      if (fits) count++;
    });
    shown.textContent = count + ' of ' + rows.length + ' rows';
  }
  function key(row, column) {
    var text = row.cells[column].textContent, number = parseFloat(text);
    return isNaN(number) ? text : number;
  }
  table.querySelectorAll('th[data-sorts]').forEach(function (head) {
    head.addEventListener('click', function () {
      var column = head.cellIndex, sign = head.dataset.sorts === 'up' ? -1 : 1;
      table.querySelectorAll('th[data-sorts]').forEach(function (other) {
        if (other !== head) { other.dataset.sorts = ''; other.removeAttribute('aria-sort'); }
      });
      head.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
      head.dataset.sorts = sign > 0 ? 'up' : 'down';
      rows.sort(function (a, b) {
        var x = key(a, column), y = key(b, column);
        if (typeof x !== typeof y) return typeof x === 'number' ? -1 : 1;
        return x < y ? -sign : x > y ? sign : 0;
      });
      rows.forEach(function (row) { body.appendChild(row); });
    });
  });
  words.addEventListener('input', apply);
  choices.forEach(function (choice) { choice.addEventListener('change', apply); });
  document.querySelectorAll('[data-shows]').forEach(function (link) {
    link.addEventListener('click', function () {
      var shows = JSON.parse(link.dataset.shows);
      words.value = '';
      choices.forEach(function (choice) { choice.value = shows[choice.name] || ''; });
      apply();
    });
  });
  apply();
})();
